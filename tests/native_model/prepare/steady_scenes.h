// Scenes that start on their steady orbit.
#pragma once

#include "tests/support/jeffcott.h"

namespace rotorub::test {

inline scene::Scene steady(const test::Jeffcott& j) {
  scene::Scene s = test::make_scene(j);
  s.initial.steady = true;
  return s;
}

// Electromagnets about a ring that two unlike springs hold.
inline scene::Scene magnetic_ring() {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5});
  s.first().stator = scene::Stator{{1.0, 1.5}, {200.0, 150.0}, {2e4, 3e4}};
  s.first().actuator = scene::Actuator{.kind = scene::ActuatorKind::kElectromagnet,
                                       .force_constant = 3e-5,
                                       .bias_current = 3.0,
                                       .air_gap = 1e-3};
  s.first().contact->clearance = 2e-3;
  return s;
}

}  // namespace rotorub::test
