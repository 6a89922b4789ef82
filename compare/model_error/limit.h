// What a figure tends to as more bending modes are kept: a pure function of its values.
//
// Values x_0, x_1, ..., x_k over rising counts n_0 < ... < n_k, as shares of the first one's
// reference (deviation(): points for shares of time), d_i = x_i - x_{i-1}. The modes left out by n
// go as 1/n (the mobility of a beam's station that carries a mass), so that beyond the last rung
//   left = d_k n_{k-1} / (n_k - n_{k-1})
// is to be expected. With e the larger of tolerance and spread of twins:
//   converged       the last two changes are within e: they cannot be distinguished from chance and
//   tolerance trend           otherwise, where the changes shrink, and what is left is less than
//   half the value no limit seen   otherwise
#pragma once

#include <optional>
#include <vector>

#include "compare/figures/figure.h"

namespace rotorub {

enum class Convergence { kConverged, kTrend, kNoLimit };
const char* to_string(Convergence convergence);  // "converged", "trend", "no limit seen"

struct FigureLimit {
  const Figure* figure = nullptr;
  std::vector<double> values;  // SI, one a rung
  Convergence convergence = Convergence::kNoLimit;
  double last_change = 0.0;  // share: d_k
  // Shares, where a limit is seen. `left`: trend only, else 0.
  std::optional<double> left;
  // What the first rung, the scene's, is off by: x_0 - (x_k + left).
  std::optional<double> error;
};

// modes: ascending; values: as many, at least kFewestRungs. spread: share, >= 0, of twins.
inline constexpr std::size_t kFewestRungs = 4;
FigureLimit figure_limit(const Figure& figure, const std::vector<int>& modes,
                         const std::vector<double>& values, double tolerance, double spread);

}  // namespace rotorub
