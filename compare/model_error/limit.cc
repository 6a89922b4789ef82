#include "compare/model_error/limit.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rotorub {
namespace {

// Signed difference on the figure's scale, relative to `reference`.
double share(const Figure& figure, double reference, double difference) {
  if (difference == 0.0 || figure.scale == Scale::kPoints) return difference;
  return difference / std::max(std::abs(reference), figure.resolution);
}

// Each change smaller than the one before, by a margin that chance does not give.
bool shrink(const std::vector<double>& changes) {
  constexpr double kMargin = 0.9;
  for (std::size_t i = 1; i < changes.size(); ++i) {
    if (std::abs(changes[i]) > kMargin * std::abs(changes[i - 1])) return false;
  }
  return true;
}

}  // namespace

const char* to_string(Convergence convergence) {
  switch (convergence) {
    case Convergence::kConverged:
      return "converged";
    case Convergence::kTrend:
      return "trend";
    case Convergence::kNoLimit:
      break;
  }
  return "no limit seen";
}

FigureLimit figure_limit(const Figure& figure, const std::vector<int>& modes,
                         const std::vector<double>& values, double tolerance, double spread) {
  assert(values.size() >= kFewestRungs && values.size() == modes.size());
  FigureLimit result{&figure, values, Convergence::kNoLimit, 0.0, {}, {}};
  const std::size_t k = values.size() - 1;
  std::vector<double> changes;
  for (std::size_t i = 1; i <= k; ++i) {
    changes.push_back(share(figure, values[0], values[i] - values[i - 1]));
  }
  result.last_change = changes.back();
  if (!std::isfinite(result.last_change)) return result;

  const double noise = std::max(tolerance, spread);
  const double off = share(figure, values[0], values[0] - values[k]);
  if (std::abs(changes[k - 1]) <= noise && std::abs(changes[k - 2]) <= noise) {
    result.convergence = Convergence::kConverged;
    result.left = 0.0;
    result.error = off;
    return result;
  }
  const double left = result.last_change * modes[k - 1] / (modes[k] - modes[k - 1]);
  const double value = std::abs(share(figure, values[0], values[k]));
  // The last three changes: the first modes are each of their own kind.
  const std::vector<double> last(changes.end() - 3, changes.end());
  if (!shrink(last) || std::abs(left) >= 0.5 * value) return result;
  result.convergence = Convergence::kTrend;
  result.left = left;
  result.error = off - left;
  return result;
}

}  // namespace rotorub
