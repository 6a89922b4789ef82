// Warnings about values of a scene that are probably mistakes (a missing unit, an extra zero, a law
// that never acts), and about a run whose energy balance is off, whose actuator is saturated or
// whose magnetic bearings do not hold the rotor. Nothing is refused.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Limits for plausible values: a larger clearance is a pipe and not a bearing, no material holds a
// rim together at a higher speed, and no metal is softer.
inline constexpr double kMostClearance = 0.2;      // relative to the rotor's radius at the contact
inline constexpr double kFastestSurface = 1000.0;  // m/s
inline constexpr double kMostFriction = 2.0;
inline constexpr double kSoftestShaft = 1e8;       // Pa
inline constexpr double kMostEccentricity = 0.01;  // m
// A shaft is unusually long beyond both: a drill string of 800 m and 0.8 m is not.
inline constexpr double kLongShaft = 100.0;     // m
inline constexpr double kMostSlender = 2000.0;  // relative to the largest diameter
inline constexpr double kWidestDisc = 10.0;     // diameter, relative to the length of the shaft
// Relative to the length of the run, which may have been shortened.
inline constexpr double kLateInstant = 10.0;
// Largest energy error of a native run with fixed steps, relative to its largest energy.
inline constexpr double kMostEnergyError = 0.01;
// Largest share of the time since switch-on that an actuator may be at its limit.
inline constexpr double kMostSaturation = 0.5;

// One sentence per doubtful value, with its key.
std::vector<std::string> doubts(const scene::Scene& scene);
// The same, and the doubts about a run of the scene.
std::vector<std::string> doubts(const scene::Scene& scene, const Trajectory& run);

}  // namespace rotorub
