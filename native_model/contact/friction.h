// The friction law of a contact, the only place that has it: one function of the slip v = gdot_T,
//
//   v != 0:  T = -mu(|v|) N sign(v),      v = 0:  |T| <= mu(0) N                     (13), (17)
//   mu(v) = kinetic + (static - kinetic) exp(-(v / v_s)^2) + viscous v
//
// with v_s the Stribeck speed (Armstrong-Helouvry, Dupont and Canudas de Wit 1994); Coulomb's mu is
// kinetic alone. Whoever needs the law asks for mu at the slip that is at hand:
// - forces at one instant (event, accelerations in MuJoCo): at the slip of that instant;
// - a phase of an impact: at the slips that it runs through (impact_friction.h);
// - a step of first order: at the slip with which it ends, as the set that is solved has it; of
//   second order: at the slip of its middle, the mean of its begin and its end; of both, which
//   depend on mu themselves, SlipFriction finds it;
// - where only one number for all slips is of use (MuJoCo's cone, closed forms): constant(), which
//   refuses a law that is none.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace rotorub {

struct FrictionLaw {
  double coefficient = 0.0;     // 1, >= 0, kinetic; Coulomb's mu
  double excess = 0.0;          // 1, >= 0, static - kinetic
  double stribeck_speed = 1.0;  // m/s, > 0, v_s
  double viscous = 0.0;         // s/m, >= 0

  FrictionLaw() = default;
  FrictionLaw(double mu) : coefficient(mu) {}  // NOLINT: a number is Coulomb's law
  bool operator==(const FrictionLaw&) const = default;

  // mu at a slip (m/s) of either sign.
  double at(double slip) const { return along(std::abs(slip)); }
  // The same of a speed along the sliding, smooth through 0: a step may look beyond its end.
  double along(double speed) const {
    if (is_constant()) return coefficient;
    return coefficient + excess * fading(speed) + viscous * speed;
  }
  // d mu / d|v|, s/m.
  double slope(double slip) const {
    const double v = std::abs(slip);
    return viscous - 2.0 * v / (stribeck_speed * stribeck_speed) * excess * fading(v);
  }
  // mu(0), which bounds sticking.
  double sticking() const { return coefficient + excess; }
  // Of all slips up to this one no mu is greater.
  double bound(double slip) const { return sticking() + viscous * std::abs(slip); }
  bool is_constant() const { return excess == 0.0 && viscous == 0.0; }
  bool none() const { return is_constant() && coefficient == 0.0; }
  // mu for one who can have no other law.
  double constant(const std::string& who) const {
    if (is_constant()) return coefficient;
    throw std::invalid_argument("contact.friction: " + who +
                                " has one coefficient for all slips; accepted: a number");
  }

 private:
  double fading(double speed) const {
    const double x = speed / stribeck_speed;
    return std::exp(-x * x);
  }
};

// mu = mu(|v(mu)|), v(mu) the slip that a solution with mu leaves: solve with mu(), improve(),
// until nothing is left to improve. More friction leaves less slip, so that
//
//   mu' = mu + (mu(|v|) - mu) / (1 + viscous |dv / dmu|)
//
// goes one way, from mu of the slip before to the first that solves it: the slip is the one that it
// reaches first from where it begins. (Where friction falls steeply slower sliding and sticking may
// be solutions too.) What sticks has dv / dmu = 0.
class SlipFriction {
 public:
  SlipFriction() = default;
  // before: m/s, the slip where the phase or the step begins.
  SlipFriction(const FrictionLaw& law, double before) : law_(law), mu_(law.at(before)) {}

  double mu() const { return mu_; }
  // By the slip (m/s) that mu() leads to, and |dv / dmu| of sliding. False: mu() is that of the
  // slip.
  bool improve(double slip, double loss = 0.0) {
    constexpr int kMostRounds = 10000;  // where two solutions are about to meet they come slowly
    constexpr double kSettled = 8.0 * std::numeric_limits<double>::epsilon();
    if (law_.is_constant() || ++rounds_ > kMostRounds) return false;
    const double swing = slip != 0.0 ? law_.viscous * loss : 0.0;
    const double next = mu_ + (law_.at(slip) - mu_) / (1.0 + swing);
    const bool moves = std::abs(next - mu_) > kSettled * next;
    if (moves) mu_ = next;
    return moves;
  }

 private:
  FrictionLaw law_{};
  double mu_ = 0.0;
  int rounds_ = 0;
};

}  // namespace rotorub
