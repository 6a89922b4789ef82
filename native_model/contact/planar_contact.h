// One planar contact with Coulomb friction. Its 2x2 systems are solved only here:
//
//   y_N = a_nn L_N + a_nt L_T + b_N          y, b: gap rate and slip (or accelerations, or gaps)
//   y_T = a_tn L_N + a_tt L_T + b_T          L: impulses (or forces)
//
// With a = W^T M^-1 W and L in N s, y is in m/s.
#pragma once

#include <cstdint>

#include "native_model/contact/friction.h"

namespace rotorub {

// The matrix a, 1/kg. It is the Delassus matrix G = W^T M^-1 W with nt = tn; only with finite
// impact times it is not symmetric.
struct Delassus {
  double nn, nt, tn, tt;
};

struct PlanarImpulse {
  double normal, friction;  // L_N, L_T
};

// Sticking: L with y_N = 0 and y_T = 0.
inline PlanarImpulse sticking_impulse(const Delassus& a, double b_n, double b_t) {
  const double determinant = a.nn * a.tt - a.nt * a.tn;
  return {(b_t * a.nt - b_n * a.tt) / determinant, (b_n * a.tn - b_t * a.nn) / determinant};
}

// Sliding, with L_T = -mu_sign L_N and mu_sign = mu sign(slip): the coefficient of L_N in y_N. If
// it is not positive, sliding wedges the contact (Painleve).
inline double sliding_coefficient(const Delassus& a, double mu_sign) {
  return a.nn - mu_sign * a.nt;
}

// Sliding: L_N with y_N = 0.
inline double sliding_normal(const Delassus& a, double b_n, double mu_sign) {
  return -b_n / sliding_coefficient(a, mu_sign);
}

// y_N and y_T after any impulse.
inline double gap_rate_after(const Delassus& a, double b_n, const PlanarImpulse& l) {
  return a.nn * l.normal + a.nt * l.friction + b_n;
}
inline double slip_after(const Delassus& a, double b_t, const PlanarImpulse& l) {
  return a.tn * l.normal + a.tt * l.friction + b_t;
}

// The case follows from the laws
//
//   y_N >= 0,   L_N >= 0,   y_N L_N = 0                                                  (13), (17)
//   |L_T| <= mu L_N,   y_T != 0:  L_T = -mu L_N sign(y_T)
//
// They apply to forces, impulses and step impulses alike: (12)-(13) with y_N the gap over the step,
// (16)-(17) for the compression phase, or accelerations. Friction is dissipative: L_T y_T <= 0.

enum class ContactMode : std::uint8_t { kFree = 0, kSlide = 1, kStick = 2 };  // of a contact

enum class ContactCase { kOpen, kStick, kSlidePositive, kSlideNegative };  // sign of the slip y_T

struct CoulombSolution {
  double normal = 0.0;    // L_N
  double friction = 0.0;  // L_T
  ContactCase contact_case = ContactCase::kOpen;
  // Number of distinct solutions. If it is 0, there is none (Painleve) and the values above mean
  // nothing; if it is above 1, this is the first in the order open, stick, slide. Both occur only
  // if mu |a_nt| >= a_nn or if the matrix is not symmetric.
  int solutions = 1;
  bool is_unique() const { return solutions == 1; }
};

inline ContactMode mode_of(double normal, bool sticks) {
  return normal <= 0.0 ? ContactMode::kFree : sticks ? ContactMode::kStick : ContactMode::kSlide;
}
inline ContactMode mode_of(const CoulombSolution& s) {
  return mode_of(s.normal, s.contact_case == ContactCase::kStick);
}

CoulombSolution solve_coulomb(const Delassus& a, double b_n, double b_t, double mu);
// The same with mu at the slip y_T. before: slip at the start of the phase or the step.
CoulombSolution solve_coulomb(const Delassus& a, double b_n, double b_t, const FrictionLaw& law,
                              double before);

}  // namespace rotorub
