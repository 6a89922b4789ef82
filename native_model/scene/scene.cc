#include "native_model/scene/scene.h"

namespace rotorub::scene {

Scene with_bearing_alone(const Scene& scene, std::size_t bearing) {
  Scene alone = scene;
  alone.auxiliary = {scene.auxiliary[bearing]};
  alone.first().name = scene.name_of(bearing);
  alone.first_index = bearing;
  return alone;
}

std::optional<double> smallest_clearance(const Scene& scene) {
  std::optional<double> smallest;
  for (const AuxiliaryBearing& at : scene.auxiliary) {
    if (!at.contact) continue;
    if (!smallest || at.contact->clearance < *smallest) smallest = at.contact->clearance;
  }
  return smallest;
}

}  // namespace rotorub::scene
