// The constants of a contact, as a model holds them.
#pragma once

#include "native_model/contact/compliance.h"
#include "native_model/contact/friction.h"

namespace rotorub {

struct ImpactLaw {  // of one contact
  FrictionLaw friction{};
  double restitution = 0.0;             // eps_N in [0, 1]
  double tangential_restitution = 0.0;  // eps_T in [0, 1]
};

// The constants of one contact.
struct ContactParameters {
  double radius, clearance;  // m
  FrictionLaw friction;
  double restitution;                       // eps_N
  double tangential_restitution;            // eps_T
  double compression_time, expansion_time;  // s
  CompliantLaw compliance{};                // rigid where there is none

  bool gives() const { return compliance.gives(); }

  ImpactLaw law() const { return {friction, restitution, tangential_restitution}; }
  double impact_time() const { return compression_time + expansion_time; }  // s
  // R / r. The surfaces meet at r e_r from the rotor's centre, which is at R e_r from the ring's,
  // R = r + delta_0: so fast a ring that turns passes there, and with this lever friction turns it.
  // With r in its place angular momentum would be lost: the force's moments about one point,
  // delta_0 + r on the rotor and -R on the ring, add up to 0.
  double surface_ratio() const { return (radius + clearance) / radius; }
};

}  // namespace rotorub
