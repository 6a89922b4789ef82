#include "native_model/rotor/magnetic_support.h"

#include <algorithm>

namespace rotorub {

MagneticSupport magnetic_support(const scene::Scene& scene) {
  if (!scene.magnetic_bearing) return {};
  const scene::MagneticBearing& bearing = *scene.magnetic_bearing;
  if (!bearing.control) return {-bearing.negative_stiffness, 0.0, 0.0};
  const scene::BearingControl& c = *bearing.control;
  const double stiffness = c.force_per_current * c.proportional - bearing.negative_stiffness;
  MagneticSupport support;
  if (c.fails_at > 0.0) support = {stiffness, c.force_per_current * c.derivative, 0.0};
  if (scene.rotor.geometry && !scene.rotor.assembled) support.held = std::max(0.0, stiffness);
  return support;
}

scene::RotorGeometry supported(const scene::Scene& scene) {
  scene::RotorGeometry geometry = *scene.rotor.geometry;
  const double held = magnetic_support(scene).held;
  if (held > 0.0) {
    geometry.bearings.push_back({scene.magnetic_bearing->station, {held, held}, {0.0, 0.0}});
  }
  return geometry;
}

}  // namespace rotorub
