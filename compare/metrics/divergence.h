// Comparison of two runs of one scene: the time at which they part, and their first impacts.
#pragma once

#include <optional>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Distance between the rotor's positions in two runs, over the rows at common times. With several
// contacts it is, in each row, the largest distance at any of them.
struct Divergence {
  double threshold = 0.0;      // m
  std::optional<double> time;  // s, of the first row beyond the threshold; empty if there is none
  double max_distance = 0.0;   // m
  double rms_distance = 0.0;   // m
  std::size_t rows = 0;        // number of compared rows
};

inline constexpr double kDivergenceShare = 0.01;  // threshold relative to the smallest clearance

// Both runs must be of one scene. threshold: m, > 0.
Divergence divergence(const Trajectory& a, const Trajectory& b, double threshold);

// The n-th counted impact of each run; empty if the run has fewer.
struct ImpactPair {
  std::optional<Impact> a, b;
};

// The first `n` pairs at most. With a soft contact, an impact is an episode of contact.
std::vector<ImpactPair> pair_impacts(const Trajectory& a, const Trajectory& b, std::size_t n);

}  // namespace rotorub
