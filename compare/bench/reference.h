// What errors are measured against: `event` at the tightest tolerance that round-off leaves a use
// for, with an error estimate; and in place of its positions and normal force the closed form
// (native_model/oracles), where the scene has one.
#pragma once

#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::bench {

// The closed form of the scene, if it has one: replaces positions and normal force, row by row.
// Gives its name; empty where there is none.
std::string put_closed_form(const scene::Scene& scene, Trajectory& trajectory);

struct Reference {
  std::string source;         // what it is, in a few words
  std::vector<double> times;  // s, of its rows
  Trajectory trajectory;
  // m. Of a closed form its round-off; else the largest distance between the reference and the runs
  // at 3 and at 10 times its tolerance.
  double error = 0.0;
  double event_distance = 0.0;  // m: of the closed form and `event`; 0 without a closed form
};

// Tolerance of the reference, relative.
inline constexpr double kReferenceTolerance = 1e-13;
// Errors under so many times the reference's own are not distinguished from it.
inline constexpr double kReferenceMargin = 100.0;

// The rows that errors are looked at: at ends of steps of the whole ladder, as between them an
// engine interpolates, across an impact in first order. Multiples of the least common multiple of
// the steps, some thousand; where that is no whole number of nanoseconds, or leaves fewer than
// kFewestRows, the rows of the scene.
std::vector<double> common_times(const scene::Run& run, const std::vector<double>& steps);
inline constexpr double kMostRows = 1000.0, kFewestRows = 200.0;

// `request` holds the rows. Throws std::runtime_error where `event` cannot run the scene to its
// end.
Reference make_reference(const scene::Scene& scene, const RunRequest& request);

// Largest distance of rotor or ring between two trajectories with the same rows; m.
double position_distance(const Trajectory& a, const Trajectory& b);

}  // namespace rotorub::bench
