#include "native_model/prepare/prepare.h"

#include "native_model/prepare/orbit_start.h"
#include "native_model/prepare/rub_start.h"
#include "native_model/scene/scene.h"

namespace rotorub {

Model prepare(const scene::Scene& scene) {
  return make_model(scene, [&](Model& model) {
    if (scene.initial.steady) add_orbit_start(scene, model);
    if (scene.initial.rub != scene::StartingRub::kNone) rub::add_rub_start(scene, model);
  });
}

}  // namespace rotorub
