// The reference for errors: `event` at the tightest tolerance that round-off permits, with an error
// estimate. If the scene has a closed form (native_model/oracles), it replaces the positions and
// the normal force.
#pragma once

#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::bench {

// Replaces positions and normal force row by row with the closed form of the scene. Returns its
// name; empty if there is none.
std::string put_closed_form(const scene::Scene& scene, Trajectory& trajectory);

struct Reference {
  std::string source;         // a short description
  std::vector<double> times;  // s, of its rows
  Trajectory trajectory;
  // m. With a closed form its round-off; otherwise the largest distance between the reference and
  // the runs at 3 and at 10 times its tolerance.
  double error = 0.0;
  double event_distance = 0.0;  // m, between the closed form and `event`; 0 without a closed form
};

// Relative tolerance of the reference.
inline constexpr double kReferenceTolerance = 1e-13;
// Errors below this multiple of the reference's error are not significant.
inline constexpr double kReferenceMargin = 100.0;

// The times at which errors are evaluated: ends of steps for all steps of the ladder, because
// between them an engine interpolates, with first-order errors across impacts. They are multiples
// of the least common multiple of the steps, at most about kMostRows. If that is not a whole number
// of nanoseconds or leaves fewer than kFewestRows, the rows of the scene are used.
std::vector<double> common_times(const scene::Run& run, const std::vector<double>& steps);
inline constexpr double kMostRows = 1000.0, kFewestRows = 200.0;

// request: with the rows. Throws std::runtime_error if `event` cannot run the scene to its end.
Reference make_reference(const scene::Scene& scene, const RunRequest& request);

// Largest distance of rotor or ring, at any contact, between two trajectories of one scene with the
// same rows, m.
double position_distance(const Trajectory& a, const Trajectory& b);

}  // namespace rotorub::bench
