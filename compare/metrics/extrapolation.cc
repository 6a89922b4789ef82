#include "compare/metrics/extrapolation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rotorub {

Extrapolation extrapolate(const std::array<double, 3>& values) {
  Extrapolation e;
  e.values = values;
  e.limit = values[2];
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  e.uncertainty = *high - *low;

  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
    e.reason = "a run has no finite value";
    return e;
  }
  const double scale = std::max(std::abs(*low), std::abs(*high));
  if (e.uncertainty <= kRoundOff * scale) {
    e.valid = true;
    return e;
  }

  const double first = values[1] - values[0];
  const double second = values[2] - values[1];
  if (first * second <= 0.0) {
    e.reason =
        "not monotone in the step: the figure scatters (chaotic motion, or already at its "
        "limit within its own scatter)";
    return e;
  }
  e.order = std::log2(first / second);
  if (e.order < kLowestOrder || e.order > kHighestOrder) {
    e.reason = "does not converge at a usable order over these steps";
    return e;
  }
  e.valid = true;
  e.limit = values[2] + second / (std::exp2(e.order) - 1.0);
  e.uncertainty = std::abs(e.limit - values[2]);
  return e;
}

Extrapolation limit_of_two(double whole, double half, std::string reason) {
  Extrapolation e;
  e.values = {whole, half, std::numeric_limits<double>::quiet_NaN()};
  e.limit = half;
  e.uncertainty = std::abs(half - whole);
  e.valid = reason.empty();
  e.reason = std::move(reason);
  return e;
}

Split split(const Extrapolation& native, const Extrapolation& other) {
  Split s;
  s.difference = other.values[0] - native.values[0];
  s.model_gap = other.limit - native.limit;
  s.step_error = other.values[0] - other.limit;
  s.native_step_error = native.values[0] - native.limit;
  s.uncertainty = native.uncertainty + other.uncertainty;
  s.valid = native.valid && other.valid;
  if (!other.valid) {
    s.reason = "MuJoCo: " + other.reason;
  } else if (!native.valid) {
    s.reason = "native: " + native.reason;
  }
  return s;
}

}  // namespace rotorub
