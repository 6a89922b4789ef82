// Exact solutions: dry whip on a rigid and on an elastic ring.
#pragma once

#include <complex>
#include <vector>

#include "native_model/oracles/annular_rub.h"

namespace rotorub::oracle {

// Dry whip on a rigid fixed ring without excitation, psi' = -nu:
//
//   nu' = mu nu^2 - (d/m) nu - mu omega_0^2          until rolling at nu = Omega r / delta_0
//
// In contact if and only if nu > omega_0; grows if and only if nu > (d + sqrt(d^2 + 4 mu^2 m k)) /
// (2 mu m).
struct BackwardWhip {
  double mass, damping, stiffness;  // kg, N s/m, N/m
  double friction;                  // mu > 0
  double clearance;                 // m

  double natural_frequency() const;  // rad/s, omega_0
  double growth_threshold() const;   // rad/s
  // nu(t) from nu(0) = start while sliding lasts; if start exceeds the growth threshold, until
  // blow_up.
  double whirl_speed(double start, double t) const;  // rad/s
  double blow_up(double start) const;                // s, infinite below the threshold
  double normal_force(double nu) const;              // N, m delta_0 (nu^2 - omega_0^2)
};

// Exact: backward whirl with dry friction on an elastic ring without excitation (Black 1968), with
// the spin held. Rotor (m, d, k) and ring (M, D, K) circle in contact, psi' = -nu, nu > 0. With the
// force lambda (1 + i tau) e^{i psi} of the rotor on the ring
//
//   D_r = k - m nu^2 - i d nu,  D_s = K - M nu^2 - i D nu,  H = 1/D_r + 1/D_s
//   z_r = -lambda (1 + i tau) e^{i psi} / D_r,  z_s = lambda (1 + i tau) e^{i psi} / D_s
//   z_r - z_s = delta_0 e^{i psi}:  lambda (1 + i tau) = -delta_0 / H
//   lambda = -delta_0 Re H / |H|^2,  tau = Im H / |Re H|        where Re H < 0
//
// tau is the friction that the motion requires. With tau <= mu it can exist without slip (rolling).
// A slip r Omega - delta_0 nu > 0 gives exactly mu: a slipping whip is steady at tau = mu, and
// friction accelerates a whirl with tau < mu. Existence does not imply stability.

// At psi = 0; all values rotate with e^{-i nu t}.
struct CircularWhirl {
  std::complex<double> rotor, stator;                    // m
  std::complex<double> rotor_velocity, stator_velocity;  // m/s
  double force = 0.0;                                    // N, lambda
  double friction = 0.0;                                 // tau
};

// nu in [from, to], rad/s; `to` may be infinite.
struct WhirlInterval {
  double from, to;
};

// Roots and eigenvalues throw std::invalid_argument if the iteration fails: for numbers that are
// not finite or differ by too many orders of magnitude.
struct ElasticWhip {
  Support rotor, ring;  // equal in both planes; damping > 0 in one of them
  double clearance;     // m, delta_0 > 0

  std::complex<double> compliance(double nu) const;  // m/N, H
  double normal_force(double nu) const;              // N, lambda; negative: no contact
  double friction_asked(double nu) const;            // tau; infinite if Re H >= 0
  bool rolls(double nu, double mu) const;            // Re H < 0 and tau <= mu
  CircularWhirl whirl(double nu) const;              // requires Re H < 0

  // All nu > 0 with tau(nu) = mu > 0, ascending: the steady slipping whips.
  std::vector<double> slipping_whips(double mu) const;
  // All nu > 0 with rolls(nu, mu), ascending.
  std::vector<WhirlInterval> rolling_intervals(double mu) const;

  // Stability of the slipping whip at nu with mu = tau(nu): the five eigenvalues of its
  // perturbations in the rotating frame with lasting contact, by falling real part. It is stable if
  // and only if all real parts are < 0.
  std::vector<std::complex<double>> eigenvalues(double nu) const;
};

}  // namespace rotorub::oracle
