// The trade-off of control: contact force and actuator force against the rotor's orbit, over the
// native run's last fifth (kSettledShare).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// A force is 0 if the scene is never in contact, or has no actuator.
struct Trade {
  double orbit = 0.0;  // m, largest distance of the rotor from the bearing's axis
  // N, mean normal force from first touch, including the impulses of impacts.
  double contact_force = 0.0;
  double actuator_force = 0.0;  // N, rms of the force on the ring
};
Trade trade_of(const Side& native);

// One point per scene in the given order; null for fewer than two scenes.
nlohmann::json trade_data(const std::vector<const SceneComparison*>& scenes);

}  // namespace rotorub
