// Published: the rotor of Friswell, Penny, Garvey, Lees, "Dynamics of Rotating Machines", example
// 5.9.1: two discs on a uniform shaft between two isotropic bearings. Figures of the converged
// Euler-Bernoulli beam with rotary inertia, to the digits given. (The book's own 86.66, 274.31,
// 716.78 are of a Timoshenko beam with 6 elements.)
#pragma once

#include <array>

#include "native_model/scene/scene.h"

namespace rotorub::oracle {

// Undamped, three bending modes kept.
scene::RotorGeometry friswell_rotor();

// rad/s, planar modes at rest.
inline constexpr std::array kFriswellAtRest{86.714, 274.743, 716.953};
// rad/s at 4000 rpm, by rising absolute value; backward whirl negative.
inline constexpr std::array kFriswellAt4000Rpm{-85.442, 87.855,   -252.105,
                                               295.292, -600.439, 827.42};
// rad/s, first elastic torsion mode of the free rotor.
inline constexpr double kFriswellTorsion = 650.407;

}  // namespace rotorub::oracle
