// The first impacts of two runs, side by side.
#pragma once

#include <optional>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The n-th counted impact of each run; a run that has fewer leaves its side empty.
struct ImpactPair {
  std::optional<Impact> a, b;
};

// Pairs by order, up to `n` of them. With a soft contact an impact is an episode of contact.
std::vector<ImpactPair> pair_impacts(const Trajectory& a, const Trajectory& b, std::size_t n);

// The first n counted impacts.
std::vector<Impact> first_impacts(const Trajectory& trajectory, std::size_t n);

}  // namespace rotorub
