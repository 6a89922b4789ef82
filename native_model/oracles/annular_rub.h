// Exact: synchronous full annular rub, the rotor circling in lasting sliding contact at the
// frequency Om of its excitation. With z the rotor's centre, psi its angle,
//
//   rigid ring:    m z'' + d z' + k z = U e^{i Om t} - lambda (1 + i mu) e^{i psi}, |z| = delta_0
//     A = (k - m Om^2) delta_0,  B = d Om delta_0
//     lambda = [-(A + mu B) + sqrt((A + mu B)^2 - (1 + mu^2)(A^2 + B^2 - U^2))] / (1 + mu^2)
//   elastic ring:  D_r = k - m Om^2 + i d Om, D_s likewise, H = 1/D_r + 1/D_s, h = (1 + i mu) H
//     |h|^2 lambda^2 + 2 delta_0 Re(h) lambda + delta_0^2 - U^2 / |D_r|^2 = 0
//
// for slip r Omega_s + delta_0 Om > 0. Existence is not stability.
#pragma once

#include <complex>
#include <optional>

namespace rotorub::oracle {

struct Support {
  double mass, damping, stiffness;  // kg, N s/m, N/m
};

struct AnnularRub {
  double force;                 // N, lambda >= 0
  std::complex<double> rotor;   // m, z e^{-i Om t}
  std::complex<double> stator;  // m, ring's centre, likewise
};

// frequency: Om, rad/s; load: U, N, > 0. Empty where the rub does not exist.
std::optional<AnnularRub> annular_rub(const Support& rotor, double clearance, double friction,
                                      double load, double frequency);
std::optional<AnnularRub> annular_rub(const Support& rotor, const Support& ring, double clearance,
                                      double friction, double load, double frequency);

}  // namespace rotorub::oracle
