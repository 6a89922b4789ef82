#include "compare/metrics/split.h"

namespace rotorub {

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
