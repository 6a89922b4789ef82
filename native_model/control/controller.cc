#include "native_model/control/controller.h"

#include "native_model/control/emulated_support.h"
#include "native_model/control/sliding.h"

namespace rotorub {

std::shared_ptr<const Controller> make_controller(const scene::Scene& scene, const Plant& plant) {
  if (!scene.controller) return nullptr;
  const scene::Controller& c = *scene.controller;
  switch (c.kind) {
    case scene::ControllerKind::kPassive:
      if (c.stiffness == 0.0 && c.damping == 0.0) return nullptr;
      return std::make_shared<EmulatedSupport>(c.stiffness, c.damping);
    case scene::ControllerKind::kSliding: return std::make_shared<SlidingController>(c, plant);
  }
  return nullptr;
}

}  // namespace rotorub
