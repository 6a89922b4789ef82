#include "native_model/contact/compliance.h"

#include <cassert>

namespace rotorub {

double CompliantLaw::rebound_of(double e) {
  assert(e >= 0.0 && e <= 1.0);
  if (e == 1.0) return 0.0;
  // With x = a v, ln(1 + x) - ln(1 - e x) - x (1 + e) falls from 0 and then rises without bound as
  // x approaches 1/e. Its root is found by bisection to round-off.
  const auto rises = [e](double x) {
    return std::log1p(x) - std::log1p(-e * x) - x * (1.0 + e) > 0.0;
  };
  double low = 0.5 * (1.0 - e), high = e * kMostRebound > 1.0 ? 1.0 / e : kMostRebound;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (rises(middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace rotorub
