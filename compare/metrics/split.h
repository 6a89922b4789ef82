// A difference in two: what the contact model does, and what the step does.
#pragma once

#include "compare/metrics/extrapolation.h"

namespace rotorub {

// other(dt) - native(dt) = model_gap + step_error - native_step_error, with
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
