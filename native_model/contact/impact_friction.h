// The friction of one phase of an impact, compression or expansion, where mu depends on the slip:
// what counts is the slip as it changes. Along the normal impulse L of the phase (Routh's way)
//
//   dT/dL = -mu(|v|) sign(v),   dv/dL = c + g_TT dT/dL,
//
// g_TT what the contact's friction does to its slip, c what all else does along L. A slip that has
// come to 0 stays there, or the phase is one of those that slide back, with mu(0). Of the phase the
// impulse law (17), (18)-(19) then has one number, the mean of mu over L; Coulomb's is mu itself.
// It is the limit of a contact that gives (compliance.h) as its stiffness grows.
#pragma once

#include "native_model/contact/friction.h"

namespace rotorub {

// The mean of mu over a normal impulse (N s, > 0). before: m/s, the slip where it begins; drift: c,
// 1/kg; mobility: g_TT, 1/kg, > 0.
double mean_friction(const FrictionLaw& law, double before, double drift, double mobility,
                     double normal);

// Solve with mu(), improve(), until nothing is left to improve.
class ImpactFriction {
 public:
  ImpactFriction() = default;
  ImpactFriction(const FrictionLaw& law, double before)
      : law_(law), before_(before), mu_(law.at(before)) {}

  double mu() const { return mu_; }
  // By the solution with mu(): impulses, N s, and the slip after it, m/s.
  bool improve(double normal, double friction, double after, double mobility);

 private:
  FrictionLaw law_{};
  double before_ = 0.0, mu_ = 0.0;
  int rounds_ = 0;
};

}  // namespace rotorub
