// The friction law of a contact, the only place that has it: one function of the slip v = gdot_T,
//
//   v != 0:  T = -mu(|v|) N sign(v),      v = 0:  |T| <= mu(0) N                     (13), (17)
//   mu(v) = kinetic + (static - kinetic) exp(-(v / v_s)^2) + viscous v
//
// with v_s the Stribeck speed (Armstrong-Helouvry, Dupont and Canudas de Wit 1994); Coulomb's mu is
// kinetic alone. Whoever needs the law asks for mu at the slip that is at hand:
// - forces at one instant (event, accelerations in MuJoCo): at the slip of that instant;
// - a phase of an impact, or a step of first order: at the slip with which it ends, as the set that
//   is solved has it;
// - a step of second order: at the slip of its middle, the mean of its begin and its end;
//   of both, which depend on mu themselves, SlipFriction finds it;
// - where only one number for all slips is of use (MuJoCo's cone, closed forms): constant(), which
//   refuses a law that is none.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "native_model/numerics/lanes.h"

namespace rotorub {

// T: double, or a vector of independent contacts (numerics/lanes.h).
template <class T>
struct FrictionOf {
  T coefficient{};                        // 1, >= 0, kinetic; Coulomb's mu
  T excess{};                             // 1, >= 0, static - kinetic
  T stribeck_speed = lanes::all<T>(1.0);  // m/s, > 0, v_s
  T viscous{};                            // s/m, >= 0

  FrictionOf() = default;
  FrictionOf(const T& mu) : coefficient(mu) {}  // NOLINT: a number is Coulomb's law

  bool operator==(const FrictionOf&) const = default;

  // The law of one of several contacts.
  void set(int lane, const FrictionOf<double>& law) {
    lanes::set(coefficient, lane, law.coefficient);
    lanes::set(excess, lane, law.excess);
    lanes::set(stribeck_speed, lane, law.stribeck_speed);
    lanes::set(viscous, lane, law.viscous);
  }

  // mu at a slip (m/s) of either sign.
  [[gnu::always_inline]] inline T at(const T& slip) const { return along(lanes::magnitude(slip)); }
  // The same of a speed along the sliding, smooth through 0: a step may look beyond its end.
  [[gnu::always_inline]] inline T along(const T& speed) const {
    if (is_constant()) return coefficient;
    return coefficient + excess * fading(speed / stribeck_speed) + viscous * speed;
  }
  // d mu / d|v|, s/m.
  T slope(const T& slip) const {
    const T x = lanes::magnitude(slip) / stribeck_speed;
    return viscous - lanes::all<T>(2.0) * x * fading(x) * excess / stribeck_speed;
  }
  // mu(0), which bounds sticking.
  T sticking() const { return coefficient + excess; }
  // Of all slips up to this one no mu is greater.
  T bound(const T& slip) const { return sticking() + viscous * lanes::magnitude(slip); }
  bool is_constant() const { return !lanes::any((excess != T{}) | (viscous != T{})); }
  bool none() const { return is_constant() && coefficient == 0.0; }
  // mu for one who can have no other law.
  double constant(const std::string& who) const {
    if (is_constant()) return coefficient;
    throw std::invalid_argument("contact.friction: " + who +
                                " has one coefficient for all slips; accepted: a number");
  }

 private:
  [[gnu::always_inline]] static inline T fading(const T& x) {
    T y{};
    for (int i = 0; i < lanes::kWidth<T>; ++i)
      lanes::set(y, i, std::exp(-lanes::get(x, i) * lanes::get(x, i)));
    return y;
  }
};
using FrictionLaw = FrictionOf<double>;

// mu = mu(|v(mu)|), v(mu) the slip that a solution with mu leaves: solve with mu(), improve(),
// until nothing is left to improve. More friction leaves less slip, so that
//
//   mu' = mu + (mu(|v|) - mu) / (1 + viscous |dv / dmu|)
//
// goes one way, from mu of the slip before to the first that solves it: the slip is the one that it
// reaches first from where it begins. (Where friction falls steeply slower sliding and sticking may
// be solutions too.) What sticks has dv / dmu = 0.
template <class T>
class SlipFriction {
 public:
  SlipFriction() = default;
  // before: m/s, the slip where the phase or the step begins.
  [[gnu::always_inline]] inline SlipFriction(const FrictionOf<T>& law, const T& before)
      : law_(law), mu_(law.at(before)) {}

  const T& mu() const { return mu_; }
  // By the slip (m/s) that mu() leads to, and |dv / dmu| of sliding. False: mu() is that of the
  // slip. A lane that is so stays so, however long the others take.
  [[gnu::always_inline]] inline bool improve(const T& slip, const T& loss = T{}) {
    constexpr int kMostRounds = 10000;  // where two solutions are about to meet they come slowly
    if (law_.is_constant() || ++rounds_ > kMostRounds) return false;
    const T one = lanes::all<T>(1.0), tiny = lanes::all<T>(kSettled);
    const T swing = lanes::select(slip != T{}, law_.viscous * loss, T{});
    const T next = mu_ + (law_.at(slip) - mu_) / (one + swing);
    const lanes::Mask<T> moves = lanes::magnitude(next - mu_) > tiny * next;
    mu_ = lanes::select(moves, next, mu_);
    return lanes::any(moves);
  }

 private:
  static constexpr double kSettled = 8.0 * std::numeric_limits<double>::epsilon();
  FrictionOf<T> law_{};
  T mu_{};
  int rounds_ = 0;
};

}  // namespace rotorub
