// Coefficients of a shaft bearing: springs and dampers, cross-coupling, or tables over the speed.
#pragma once

#include <array>
#include <vector>

#include "native_model/scene/rotor.h"

namespace rotorub::scene {

// table_kxx, kxy, kyx, kyy, then the same for c. Empty kyy and cyy are replaced by kxx and cxx; a
// list that is still empty means 0.
std::array<std::vector<double>, 8> coefficient_lists(const ShaftBearing& bearing);

// Stiffness of each plane in N/m at a speed in rad/s; negative table values count as 0.
PlanePair stiffness_at(const ShaftBearing& bearing, double speed);

// Fills stiffness, damping and their cross-coupling from the tables at the rotor's speed. The scene
// must have passed its checks.
void complete_bearings(Rotor& rotor);

}  // namespace rotorub::scene
