// What control trades: contact force and actuator force against the rotor's orbit, a point for each
// scene.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// Of the native run's last fifth (kSettledShare); forces of a scene that is never in contact, or
// has no actuator, are 0.
struct Trade {
  double orbit = 0.0;  // m, largest distance of the rotor from the bearing's axis
  double contact_force =
      0.0;  // N, mean normal force, impulses of impacts with it, from first touch
  double actuator_force = 0.0;  // N, rms of the force on the ring
};
Trade trade_of(const Side& native);

// One point a scene, in the order given; null for fewer than two, which trade nothing.
nlohmann::json trade_data(const std::vector<const SceneComparison*>& scenes);

}  // namespace rotorub
