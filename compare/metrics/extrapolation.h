// The limit of a figure as the step goes to 0, from runs at dt, dt/2 and, if needed, dt/4.
#pragma once

#include <array>
#include <string>

namespace rotorub {

// Richardson extrapolation with the order determined from the data: with d1 = q(dt/2) - q(dt) and
// d2 = q(dt/4) - q(dt/2), the order is p = log2(d1/d2) and the limit is q(dt/4) + d2 / (2^p - 1).
struct Extrapolation {
  std::array<double, 3> values{};  // at dt, dt/2, dt/4; the last is NaN if it was not run
  bool valid = false;              // monotone with an order in [0.5, 4], or without any difference
  double limit = 0.0;              // if not valid: the value at dt/4
  double order = 0.0;              // p; 0 if there is none
  double uncertainty = 0.0;        // |limit - q(dt/4)|; if not valid: the spread of the values
  std::string reason;              // why it is not valid; otherwise empty
};

inline constexpr double kLowestOrder = 0.5, kHighestOrder = 4.0;
// Differences below this share of the largest value are round-off, so the figure does not depend on
// the step.
inline constexpr double kRoundOff = 1e-12;

Extrapolation extrapolate(const std::array<double, 3>& values);

// From runs at dt and dt/2 only. The limit is the value at dt/2; its uncertainty is the change
// between the two, which is the remaining error of a first-order figure. reason: why this is not a
// valid limit; empty if it is.
Extrapolation limit_of_two(double whole, double half, std::string reason);

// Splits a difference into the effects of the contact model and of the step:
//
//   other(dt) - native(dt) = model_gap + step_error - native_step_error
//   model_gap         = other(dt -> 0) - native(dt -> 0)
//   step_error        = other(dt)  - other(dt -> 0)
//   native_step_error = native(dt) - native(dt -> 0)
//
// The limits are extrapolated (see Extrapolation). If one is not valid, the parts still add up but
// are not meaningful; `valid` is false, and `reason` says which limit is not valid and why.
struct Split {
  double difference = 0.0;
  double model_gap = 0.0;
  double step_error = 0.0;
  double native_step_error = 0.0;
  double uncertainty = 0.0;  // of the model gap: sum of the limits' uncertainties
  bool valid = false;
  std::string reason;
};

Split split(const Extrapolation& native, const Extrapolation& other);

}  // namespace rotorub
