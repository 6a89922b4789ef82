// A shaft bearing in its words: springs and dashpots, across the planes too, or tables over the
// speed.
#pragma once

#include <array>
#include <vector>

#include "native_model/scene/checker.h"

namespace rotorub::scene {

// Cross-checks of [[rotor.bearing]].
void check_bearings(const Checker& check, const RotorGeometry& shaft);

// table_kxx, kxy, kyx, kyy, then c alike, with those that stand for others; empty: 0.
std::array<std::vector<double>, 8> coefficient_lists(const ShaftBearing& bearing);

// N/m, of each plane at a speed, rad/s; 0 where a table's is negative.
PlanePair stiffness_at(const ShaftBearing& bearing, double speed);

// stiffness, damping and the crosses of those with tables, at the rotor's speed; of a scene that
// was found sound.
void complete_bearings(Rotor& rotor);

}  // namespace rotorub::scene
