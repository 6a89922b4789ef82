// The value that a figure tends to as the step goes to 0, from runs at dt, dt/2 and, where that
// tells more, dt/4.
#pragma once

#include <array>
#include <string>

namespace rotorub {

// Richardson extrapolation with the order taken from the data: with d1 = q(dt/2) - q(dt) and
// d2 = q(dt/4) - q(dt/2), order p = log2(d1/d2) and limit = q(dt/4) + d2 / (2^p - 1).
struct Extrapolation {
  std::array<double, 3> values{};  // at dt, dt/2, dt/4; the last is NaN where it was not run
  bool valid = false;              // monotone, order in [0.5, 4]; or no difference at all
  double limit = 0.0;              // where not valid: the value at dt/4, for what it is worth
  double order = 0.0;              // p; 0 where there is none
  double uncertainty = 0.0;        // |limit - q(dt/4)|; where not valid: the spread of the values
  std::string reason;              // why it is not valid; empty where it is
};

inline constexpr double kLowestOrder = 0.5, kHighestOrder = 4.0;
// Differences below this share of the largest value are round-off: the figure does not depend on
// the step.
inline constexpr double kRoundOff = 1e-12;

Extrapolation extrapolate(const std::array<double, 3>& values);

// From runs at dt and dt/2 only. The limit is the value at dt/2; its uncertainty is the change
// between the two, which is the remaining error of a figure of first order. reason: why this is not
// a limit; empty if it is.
Extrapolation limit_of_two(double whole, double half, std::string reason);

// A difference in two: what the contact model does, and what the step does,
//
// other(dt) - native(dt) = model_gap + step_error - native_step_error
//   model_gap         = other(dt -> 0) - native(dt -> 0)
//   step_error        = other(dt)  - other(dt -> 0)
//   native_step_error = native(dt) - native(dt -> 0)
// The limits are extrapolated (see Extrapolation); where one is not valid the parts still add up,
// but say nothing: `valid` is false and `reason` says which limit and why.
struct Split {
  double difference = 0.0;
  double model_gap = 0.0;
  double step_error = 0.0;
  double native_step_error = 0.0;
  double uncertainty = 0.0;  // of the model gap: sum of the limits' own
  bool valid = false;
  std::string reason;
};

Split split(const Extrapolation& native, const Extrapolation& other);

}  // namespace rotorub
