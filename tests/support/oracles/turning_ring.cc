#include "tests/support/oracles/turning_ring.h"

#include <cmath>

namespace rotorub::oracle {

double ring_speed(const TurningRing& ring, double torque, double start, double t) {
  const double decays = ring.drag * t / ring.inertia;
  // (1 - e^-x) / x, 1 without drag.
  const double mean = decays > 0.0 ? -std::expm1(-decays) / decays : 1.0;
  return start * std::exp(-decays) + torque / ring.inertia * t * mean;
}

double rolling_surface_speed(const FreeSpin& rotor, const TurningRing& ring, double ring_speed) {
  const double r = rotor.radius, R = ring.bore_radius;
  return (R * rotor.inertia * rotor.speed + r * ring.inertia * ring_speed) /
         (rotor.inertia * R / r + ring.inertia * r / R);
}

}  // namespace rotorub::oracle
