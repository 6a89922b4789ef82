// The friction law of a contact, the only place that has it: one function of the slip v = gdot_T,
//
//   v != 0:  T = -mu(|v|) N sign(v),      v = 0:  |T| <= mu(0) N                     (13), (17)
//
// Coulomb's mu is constant. Whoever needs the law asks for mu at the slip that is at hand:
// - forces at one instant (event): at the slip of that instant;
// - a step or a phase of an impact: at the slip with which it begins, or would end without the
//   contact's impulses. mu then is one number in the set that is solved;
// - where only one number for all slips is of use (MuJoCo's cone, closed forms): constant(), which
//   refuses a law that is none.
#pragma once

#include <stdexcept>
#include <string>

namespace rotorub {

// T: double, or a vector of independent contacts (numerics/lanes.h).
template <class T>
struct FrictionOf {
  T coefficient{};  // 1, >= 0, mu

  constexpr FrictionOf() = default;
  constexpr FrictionOf(const T& mu) : coefficient(mu) {}  // NOLINT: a number is Coulomb's law

  // mu at a slip (m/s) of either sign.
  [[gnu::always_inline]] inline T at(const T& /*slip*/) const { return coefficient; }
  // mu(0), which bounds sticking.
  T sticking() const { return at(T{}); }
  bool is_constant() const { return true; }
  bool none() const { return is_constant() && coefficient == 0.0; }
  // mu for one who can have no other law.
  double constant(const std::string& who) const {
    if (is_constant()) return coefficient;
    throw std::invalid_argument("contact.friction: " + who +
                                " has one coefficient for all slips; this law depends on the slip");
  }
};
using FrictionLaw = FrictionOf<double>;

}  // namespace rotorub
