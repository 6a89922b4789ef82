// The constants of one contact.
#pragma once

#include "native_model/contact/friction.h"
#include "native_model/contact/impact.h"

namespace rotorub {

struct ContactParameters {
  double radius, clearance;  // m
  FrictionLaw friction;
  double restitution;                       // eps_N
  double tangential_restitution;            // eps_T
  double compression_time, expansion_time;  // s

  ImpactLaw law() const { return {friction, restitution, tangential_restitution}; }
  double impact_time() const { return compression_time + expansion_time; }  // s
  // R / r. The surfaces meet at r e_r from the rotor's centre, which is at R e_r from the ring's,
  // R = r + delta_0: so fast a ring that turns passes there, and with this lever friction turns it.
  // With r in its place angular momentum would be lost: the force's moments about one point,
  // delta_0 + r on the rotor and -R on the ring, add up to 0.
  double surface_ratio() const { return (radius + clearance) / radius; }
};

}  // namespace rotorub
