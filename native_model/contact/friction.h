// The friction law of a contact, implemented only here. The coefficient depends on the slip v =
// gdot_T:
//
//   v != 0:  T = -mu(|v|) N sign(v),      v = 0:  |T| <= mu(0) N                     (13), (17)
//   mu(v) = kinetic + (static - kinetic) exp(-(v / v_s)^2) + viscous v
//
// with the Stribeck speed v_s (Armstrong-Helouvry, Dupont and Canudas de Wit 1994). Coulomb's law
// has the kinetic part only. Each user evaluates mu at a suitable slip:
// - Forces at one instant (event, accelerations in MuJoCo) use the slip of that instant.
// - A phase of an impact uses all slips that it runs through (impact_friction.h).
// - A step of first order uses the slip at its end, like the set that is solved. A step of second
//   order uses the slip at its middle, the mean of its start and its end. Both slips depend on mu,
//   and SlipFriction finds a consistent pair.
// - Methods that need one number for all slips (MuJoCo's cone, closed forms) call constant(), which
//   rejects a law that depends on the slip.
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
  // mu for a speed (m/s) along the sliding direction. It is smooth through 0, because a step may
  // evaluate it beyond its end.
  double along(double speed) const {
    if (is_constant()) return coefficient;
    return coefficient + excess * fading(speed) + viscous * speed;
  }
  // d mu / d|v|, s/m.
  double slope(double slip) const {
    const double v = std::abs(slip);
    return viscous - 2.0 * v / (stribeck_speed * stribeck_speed) * excess * fading(v);
  }
  // mu(0), the bound for sticking.
  double sticking() const { return coefficient + excess; }
  // Upper bound of mu over all slips up to this one.
  double bound(double slip) const { return sticking() + viscous * std::abs(slip); }
  bool is_constant() const { return excess == 0.0 && viscous == 0.0; }
  bool is_frictionless() const { return is_constant() && coefficient == 0.0; }
  // mu for a method that supports no other law; `who` names the method in the message.
  double constant(const std::string& who) const {
    if (is_constant()) return coefficient;
    throw std::invalid_argument("contact.friction: " + who +
                                " has one coefficient for all slips; give a number");
  }

 private:
  double fading(double speed) const {
    const double x = speed / stribeck_speed;
    return std::exp(-x * x);
  }
};

// Solves mu = mu(|v(mu)|), where v(mu) is the slip of the solution with mu: solve with mu(), call
// improve(), and repeat until it returns false. More friction leaves less slip, so the iteration
//
//   mu' = mu + (mu(|v|) - mu) / (1 + viscous |dv / dmu|)
//
// is monotone. It starts at mu of the slip before and converges to the first solution, whose slip
// is the first that the contact reaches from there. (Where friction falls steeply, slower sliding
// and sticking may be solutions too.) Sticking has dv / dmu = 0.
class SlipFriction {
 public:
  SlipFriction() = default;
  // before: m/s, slip at the start of the phase or the step.
  SlipFriction(const FrictionLaw& law, double before) : law_(law), mu_(law.at(before)) {}

  double mu() const { return mu_; }
  // slip: m/s, result with mu(); loss: |dv / dmu| of sliding. Returns false if mu() agrees with the
  // slip, or after kMostRounds.
  bool improve(double slip, double loss = 0.0) {
    constexpr int kMostRounds = 10000;  // convergence is slow where two solutions nearly coincide
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
