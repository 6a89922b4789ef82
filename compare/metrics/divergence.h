// Two runs of one scene side by side: where they part, and their first impacts.
#pragma once

#include <optional>
#include <vector>

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

// The n-th counted impact of each run; a run that has fewer leaves its side empty.
struct ImpactPair {
  std::optional<Impact> a, b;
};

// Pairs by order, up to `n` of them. With a soft contact an impact is an episode of contact.
std::vector<ImpactPair> pair_impacts(const Trajectory& a, const Trajectory& b, std::size_t n);

// The first n counted impacts.
std::vector<Impact> first_impacts(const Trajectory& trajectory, std::size_t n);

}  // namespace rotorub
