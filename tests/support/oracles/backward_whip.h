// Exact: dry friction backward whip on a rigid fixed ring without excitation, psi' = -nu:
//
//   nu' = mu nu^2 - (d/m) nu - mu omega_0^2          until rolling at nu = Omega r / delta_0
//
// In contact iff nu > omega_0; grows iff nu > (d + sqrt(d^2 + 4 mu^2 m k)) / (2 mu m).
#pragma once

namespace rotorub::oracle {

struct BackwardWhip {
  double mass, damping, stiffness;  // kg, N s/m, N/m
  double friction;                  // mu > 0
  double clearance;                 // m

  double natural_frequency() const;  // rad/s, omega_0
  double growth_threshold() const;   // rad/s
  // nu(t) from nu(0) = start, while sliding lasts; start above the growth threshold: before
  // blow_up.
  double whirl_speed(double start, double t) const;  // rad/s
  double blow_up(double start) const;                // s, infinity below the threshold
  double normal_force(double nu) const;              // N, m delta_0 (nu^2 - omega_0^2)
};

}  // namespace rotorub::oracle
