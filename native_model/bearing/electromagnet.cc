#include "native_model/bearing/electromagnet.h"

#include <algorithm>
#include <cmath>

namespace rotorub {

Electromagnet::Gaps Electromagnet::gaps(double s) const {
  const double reach = kReach * p_.air_gap, at = std::clamp(s, -reach, reach);
  const double near = p_.air_gap - at, far = p_.air_gap + at;
  return {1.0 / (near * near), 1.0 / (far * far)};
}

double Electromagnet::force(double s, double i) const {
  const Gaps g = gaps(s);
  const double pull = p_.bias_current + i, oppose = p_.bias_current - i;
  return p_.force_constant * (g.pulling * pull * pull - g.opposing * oppose * oppose) -
         p_.stiffness * s;
}

double Electromagnet::gain(double s, double i) const {
  const Gaps g = gaps(s);
  return p_.force_constant *
         (2.0 * p_.bias_current * (g.pulling + g.opposing) + i * (g.pulling - g.opposing));
}

// With A, B = 1/(s_0 -+ s)^2 and y = (F + c s)/k_m:
//   (A - B) i^2 + 2 i_0 (A + B) i + (A - B) i_0^2 - y = 0,
// the root that rises with y, without cancellation.
double Electromagnet::current(double s, double force, double limit) const {
  const Gaps g = gaps(s);
  const double i0 = p_.bias_current, sum = g.pulling + g.opposing;
  const double difference = g.pulling - g.opposing;
  const double y = (force + p_.stiffness * s) / p_.force_constant;
  const double square = 4.0 * i0 * i0 * g.pulling * g.opposing + difference * y;
  if (!(square > 0.0)) return std::copysign(limit, y);  // no current gives so much
  const double i = (y - difference * i0 * i0) / (i0 * sum + std::sqrt(square));
  return std::clamp(i, -limit, limit);
}

}  // namespace rotorub
