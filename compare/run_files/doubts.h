// Values that a scene may have and that are hardly meant (a unit forgotten, a zero too many, a law
// that never acts), and a run whose energy does not add up. Nothing is refused for them.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// A clearance beyond so many radii is a pipe, not a bearing; beyond this speed no material holds a
// rim together; softer than this is no metal.
inline constexpr double kMostClearance = 0.2;      // of the rotor's radius at the contact
inline constexpr double kFastestSurface = 1000.0;  // m/s
inline constexpr double kMostFriction = 2.0;
inline constexpr double kSoftestShaft = 1e8;       // Pa
inline constexpr double kMostEccentricity = 0.01;  // m
inline constexpr double kLateInstant = 10.0;       // of the run: a run may be cut short
// A native run of steps whose energy is off by a larger share of the most that it had.
inline constexpr double kMostEnergyError = 0.01;

// A sentence each, with key and value; none: nothing is in doubt.
std::vector<std::string> doubts(const scene::Scene& scene);
// The same, and what is doubtful of a run of the scene.
std::vector<std::string> doubts(const scene::Scene& scene, const Trajectory& run);

}  // namespace rotorub
