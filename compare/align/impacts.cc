#include "compare/align/impacts.h"

#include <algorithm>

namespace rotorub {

std::vector<Impact> first_impacts(const Trajectory& trajectory, std::size_t n) {
  std::vector<Impact> first;
  for (const Impact& impact : trajectory.impacts) {
    if (first.size() == n) break;
    if (counts(impact)) first.push_back(impact);
  }
  return first;
}

std::vector<ImpactPair> pair_impacts(const Trajectory& a, const Trajectory& b, std::size_t n) {
  const auto first_a = first_impacts(a, n);
  const auto first_b = first_impacts(b, n);
  std::vector<ImpactPair> pairs(std::max(first_a.size(), first_b.size()));
  for (std::size_t i = 0; i < first_a.size(); ++i) pairs[i].a = first_a[i];
  for (std::size_t i = 0; i < first_b.size(); ++i) pairs[i].b = first_b[i];
  return pairs;
}

}  // namespace rotorub
