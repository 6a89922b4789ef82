// The constants of a contact in a model.
#pragma once

#include "native_model/contact/compliance.h"
#include "native_model/contact/friction.h"

namespace rotorub {

// The law of one contact in its impacts (impact.h).
struct ImpactLaw {
  FrictionLaw friction{};
  double restitution = 0.0;             // eps_N in [0, 1]
  double tangential_restitution = 0.0;  // eps_T in [0, 1]
};

// The geometry of a contact and the constants of all its laws: Coulomb's or falling friction
// (friction.h); for a rigid contact Poisson's restitution (impact.h), instantaneous or with
// compression and expansion times; for a compliant one the normal force (compliance.h).
struct ContactParameters {
  double radius, clearance;  // m
  FrictionLaw friction;
  double restitution;                       // eps_N
  double tangential_restitution;            // eps_T
  double compression_time, expansion_time;  // s
  CompliantLaw compliance{};                // default: rigid

  bool is_compliant() const { return compliance.is_compliant(); }

  ImpactLaw impact_law() const { return {friction, restitution, tangential_restitution}; }
  double impact_time() const { return compression_time + expansion_time; }  // s
  // R / r with R = r + delta_0. The surfaces touch at r e_r from the rotor's centre and at R e_r
  // from the ring's centre. The surface of a turning ring therefore moves at R Omega_r there, and
  // friction acts on the ring with the lever R. A lever r would violate the balance of angular
  // momentum: about a common point, the moments of the contact force on the rotor (lever delta_0 +
  // r) and on the ring (-R) add up to 0.
  double surface_ratio() const { return (radius + clearance) / radius; }
};

}  // namespace rotorub
