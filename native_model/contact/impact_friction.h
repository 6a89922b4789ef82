// The friction of one phase of an impact, compression or expansion, for a mu that depends on the
// slip. The slip changes along the normal impulse L of the phase (Routh's method):
//
//   dT/dL = -mu(|v|) sign(v),   dv/dL = c + g_TT dT/dL,
//
// where g_TT is the effect of the contact's friction on its own slip, and c the effect of
// everything else along L. After the slip has reached 0, mu(0) applies for the rest of the phase,
// whether the contact then sticks or slides back. The impulse laws (17), (18)-(19) use one number
// for the phase, the mean of mu over L; for Coulomb's law it is mu itself. This is the limit of a
// compliant contact (compliance.h) as its stiffness grows.
#pragma once

#include "native_model/contact/friction.h"

namespace rotorub {

// Usage: solve with mu(), call improve(), and repeat until it returns false.
class ImpactFriction {
 public:
  ImpactFriction() = default;
  ImpactFriction(const FrictionLaw& law, double before)
      : law_(law), before_(before), mu_(law.at(before)) {}

  double mu() const { return mu_; }
  // Takes the solution with mu(): its impulses, N s, the slip after it, m/s, and g_TT, 1/kg.
  bool improve(double normal, double friction, double after, double mobility);

 private:
  FrictionLaw law_{};
  double before_ = 0.0, mu_ = 0.0;
  int rounds_ = 0;
};

}  // namespace rotorub
