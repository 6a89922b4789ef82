// One planar contact with Coulomb friction: which case of planar_contact.h holds.
//
//   y_N = a_nn L_N + a_nt L_T + b_N >= 0,   L_N >= 0,   y_N L_N = 0              (13), (17)
//   y_T = a_tn L_N + a_tt L_T + b_T,        |L_T| <= mu L_N,
//                                           y_T != 0:  L_T = -mu L_N sign(y_T)
//
// Forces, impulses or step impulses alike: (12)-(13) with y_N the gap over the step, (16)-(17) the
// compression phase, or accelerations. Friction is dissipative: L_T y_T <= 0.
#pragma once

#include <cstdint>

#include "native_model/contact/kinematics.h"

namespace rotorub {

enum class Mode : std::uint8_t { kFree = 0, kSlide = 1, kStick = 2 };  // of a contact

enum class ContactCase { kOpen, kStick, kSlidePositive, kSlideNegative };  // sign of the slip y_T

struct CoulombSolution {
  double normal = 0.0;    // L_N
  double friction = 0.0;  // L_T
  ContactCase contact_case = ContactCase::kOpen;
  // Number of distinct solutions; 0: none (Painleve), above 1: the first of open, stick, slide is
  // given. Both arise only where mu |a_nt| > a_nn, or with an unsymmetric matrix.
  int solutions = 1;
};

inline Mode mode_of(double normal, bool sticks) {
  return normal <= 0.0 ? Mode::kFree : sticks ? Mode::kStick : Mode::kSlide;
}
inline Mode mode_of(const CoulombSolution& s) {
  return mode_of(s.normal, s.contact_case == ContactCase::kStick);
}

CoulombSolution solve_coulomb(const Delassus& a, double b_n, double b_t, double mu);

}  // namespace rotorub
