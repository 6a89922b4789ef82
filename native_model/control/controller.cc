#include "native_model/control/controller.h"

#include "native_model/control/library.h"
#include "native_model/control/quadratic.h"
#include "native_model/control/radial_tracking.h"
#include "native_model/control/ring_feedback.h"
#include "native_model/control/sliding.h"

namespace rotorub {
namespace {

template <typename Law>
std::shared_ptr<const Controller> tracking(const scene::Scene& scene, std::size_t bearing,
                                           const Plant& plant) {
  const scene::Controller& settings = *scene.auxiliary[bearing].controller;
  auto law = std::make_shared<Law>(settings, plant, scene.rotor.speed);
  refuse_delay(scene, bearing, plant, *law);
  return law;
}

}  // namespace

std::shared_ptr<const Controller> make_controller(const scene::Scene& scene, std::size_t bearing,
                                                  const Plant& plant) {
  if (!scene.auxiliary[bearing].controller) return nullptr;
  const scene::Controller& c = *scene.auxiliary[bearing].controller;
  switch (c.kind) {
    case scene::ControllerKind::kPassive:
      // Without a command that balances their bias, magnets are not a passive bearing.
      if (c.stiffness == 0.0 && c.damping == 0.0 && plant.current_limit == 0.0) return nullptr;
      return std::make_shared<EmulatedSupport>(c.stiffness, c.damping);
    case scene::ControllerKind::kSliding:
      return tracking<SlidingController>(scene, bearing, plant);
    case scene::ControllerKind::kCrossCoupled:
      return std::make_shared<CrossCoupled>(c);
    case scene::ControllerKind::kTwoPhase:
      return tracking<TwoPhase>(scene, bearing, plant);
    case scene::ControllerKind::kPd:
      return std::make_shared<TrackingPd>(c, plant);
    case scene::ControllerKind::kLqr:
      return std::make_shared<StateFeedback>(quadratic_design(scene, bearing, *plant.linear));
    case scene::ControllerKind::kLqg:
      return std::make_shared<OutputFeedback>(quadratic_design(scene, bearing, *plant.linear),
                                              plant.force_limit);
    case scene::ControllerKind::kLibrary:
      if (libraries_left_out()) return std::make_shared<UnopenedLibrary>();
      return std::make_shared<LibraryController>(scene, bearing, plant);
  }
  return nullptr;
}

}  // namespace rotorub
