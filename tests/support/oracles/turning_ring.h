// Exact: a ring that turns about its axis (J_r, viscous drag c_r), driven by friction on its bore
// at R = r + delta_0 from its axis. With the friction lambda_T on the rotor (along e_t):
//
//   J_r Omega_r' = -R lambda_T - c_r Omega_r,   J Omega' = r lambda_T           (a free spin)
//
//   sliding under a constant normal force N, lambda_T = -s mu N, s the sign of the slip:
//     Omega_r(t) = Omega_inf + (Omega_r(0) - Omega_inf) e^{-c_r t / J_r},
//     Omega_inf = s mu N R / c_r
//   without drag, R J Omega + r J_r Omega_r is constant, whatever the bending; when rolling with
//   the centres at rest, r Omega = R Omega_r:
//     surface speed = (R J Omega + r J_r Omega_r) / (J R / r + J_r r / R)
#pragma once

#include <cmath>

namespace rotorub::oracle {

struct TurningRing {
  double inertia;      // kg m^2, J_r > 0
  double drag;         // N m s, c_r >= 0
  double bore_radius;  // m, R > 0
};

// rad/s: Omega_r after sliding for the time t (s, >= 0) from the speed `start` (rad/s). torque:
// friction torque s mu N R that drives the ring, N m.
inline double ring_speed(const TurningRing& ring, double torque, double start, double t) {
  const double decays = ring.drag * t / ring.inertia;
  // (1 - e^-x) / x, 1 without drag.
  const double mean = decays > 0.0 ? -std::expm1(-decays) / decays : 1.0;
  return start * std::exp(-decays) + torque / ring.inertia * t * mean;
}

struct FreeSpin {
  double inertia, radius, speed;  // kg m^2, m, rad/s
};
// m/s: speed of both surfaces once they roll, for a ring without drag that turns at `ring_speed`.
inline double rolling_surface_speed(const FreeSpin& rotor, const TurningRing& ring,
                                    double ring_speed) {
  const double r = rotor.radius, R = ring.bore_radius;
  return (R * rotor.inertia * rotor.speed + r * ring.inertia * ring_speed) /
         (rotor.inertia * R / r + ring.inertia * r / R);
}

}  // namespace rotorub::oracle
