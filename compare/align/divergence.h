// Where two runs of one scene part.
#pragma once

#include <optional>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Distance between the rotor's positions in two runs, over the rows whose times both have.
struct Divergence {
  double threshold = 0.0;      // m
  std::optional<double> time;  // s, of the first row beyond the threshold; none: never
  double max_distance = 0.0;   // m
  double rms_distance = 0.0;   // m
  std::size_t rows = 0;        // compared
};

inline constexpr double kDivergenceShare = 0.01;  // threshold as a share of the clearance

// threshold: m, > 0.
Divergence divergence(const Trajectory& a, const Trajectory& b, double threshold);

}  // namespace rotorub
