#include "compare/metrics/divergence.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

struct RotorPath {  // at one contact, m, in rows
  const std::vector<double>&x, &y;
};

std::vector<RotorPath> rotor_paths(const Trajectory& run) {
  std::vector<RotorPath> paths;
  for (std::size_t k = 0; k < run.contacts; ++k) {
    paths.push_back(
        {run.column(column_of_contact(k, "rotor_x")), run.column(column_of_contact(k, "rotor_y"))});
  }
  return paths;
}

// The first n counted impacts.
std::vector<Impact> first_impacts(const Trajectory& trajectory, std::size_t n) {
  std::vector<Impact> first;
  for (const Impact& impact : trajectory.impacts) {
    if (first.size() == n) break;
    if (counts(impact)) first.push_back(impact);
  }
  return first;
}

}  // namespace

Divergence divergence(const Trajectory& a, const Trajectory& b, double threshold) {
  const auto& time_a = a.column("t");
  const auto& time_b = b.column("t");
  const std::vector<RotorPath> paths_a = rotor_paths(a), paths_b = rotor_paths(b);
  assert(paths_a.size() == paths_b.size());

  Divergence result;
  result.threshold = threshold;
  double square = 0.0;
  // Both series ascend and contain requested times exactly, so rows match by equality.
  for (std::size_t i = 0, j = 0; i < time_a.size() && j < time_b.size();) {
    if (time_a[i] < time_b[j]) {
      ++i;
    } else if (time_b[j] < time_a[i]) {
      ++j;
    } else {
      const auto apart = [&](std::size_t contact) {
        const RotorPath &in_a = paths_a[contact], &in_b = paths_b[contact];
        return std::hypot(in_a.x[i] - in_b.x[j], in_a.y[i] - in_b.y[j]);
      };
      double distance = apart(0);
      for (std::size_t k = 1; k < paths_a.size(); ++k) distance = std::max(distance, apart(k));
      result.max_distance = std::max(result.max_distance, distance);
      square += distance * distance;
      ++result.rows;
      if (distance > threshold && !result.time) result.time = time_a[i];
      ++i, ++j;
    }
  }
  if (result.rows > 0) result.rms_distance = std::sqrt(square / static_cast<double>(result.rows));
  return result;
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
