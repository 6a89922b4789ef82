// A compliant contact. With the penetration p = |d| - delta_0 (m) of the rotor into the ring and
// its rate p' = -gdot_N, the normal force while it is compressive (N > 0) is one of
//
//   N = k p^n (1 + a p')     Hunt and Crossley, J. Appl. Mech. 42 (1975) 440; n = 1 is a line
//                            contact, n = 3/2 Hertz's contact
//   N = k p + c p'           n = 1, a spring and a damper
//
// If a scene states neither a nor c, each touch gets the a with which free masses that approach at
// v rebound with the restitution e, for any k and n:
//
//   ln[(1 + a v) / (1 - a e v)] = a v (1 + e)
//
// The product a v depends on e only: it is 0 for e = 1 and 1/e for small e. It is limited
// (kMostRebound), because e = 0 has no finite solution. The speed v is at least kLeastSpeed,
// because a would grow without bound for grazing touches. A contact that begins closed
// (begins_closed) has a = 0, because it is loaded without an impact and no touch has a speed.
//
// Friction follows friction.h with this N. Sticking is rigid.
#pragma once

#include <cmath>
#include <optional>

#include "native_model/contact/kinematics.h"

namespace rotorub {

// [contact.compliance]
struct Compliance {
  double stiffness = 0.0;                    // N/m^n, > 0, k
  double exponent = 1.0;                     // 1, in [1, 2], n
  std::optional<double> hunt_crossley = {};  // s/m, >= 0, a
  std::optional<double> damping = {};        // N s/m, >= 0, c; only with n = 1

  bool by_restitution() const { return !hunt_crossley && !damping; }
};

// The law as the models use it. The contact is rigid if the stiffness is 0.
struct CompliantLaw {
  // a v for a restitution in [0, 1], at most kMostRebound; the least restitution that can be
  // attained is therefore 0.01.
  static constexpr double kMostRebound = 100.0;
  static double rebound_of(double restitution);
  // m/s; a slower touch has the same a as a touch at this speed.
  static constexpr double kLeastSpeed = 1e-4;

  double stiffness = 0.0, exponent = 1.0;  // N/m^n, n
  double damping = 0.0;                    // N s/m, c
  double hunt_crossley = 0.0;              // s/m, a of every touch, if the scene states it
  double rebound = 0.0;                    // a v, if a follows from the restitution

  CompliantLaw() = default;
  CompliantLaw(const Compliance& of, double restitution)
      : stiffness(of.stiffness),
        exponent(of.exponent),
        damping(of.damping.value_or(0.0)),
        hunt_crossley(of.hunt_crossley.value_or(0.0)),
        rebound(of.by_restitution() ? rebound_of(restitution) : 0.0) {}

  bool is_compliant() const { return stiffness > 0.0; }  // false: the contact is rigid

  // True if a contact is closed in a state that no motion led to (a start, a reset, a keyframe, a
  // state that was written): it penetrates at any speed, or rests on the circle. gap, clearance: m;
  // gap_rate: m/s.
  static bool begins_closed(double gap, double gap_rate, double clearance) {
    return gap < -kOnCircle * clearance || rests_on_circle(gap, gap_rate, clearance);
  }
  // s/m, a of a contact that begins closed: the stated value, or 0.
  double a_of_start() const { return hunt_crossley; }
  // s/m, a of a touch at this speed (m/s).
  double a_of_touch(double speed) const {
    if (rebound == 0.0 || speed <= 0.0) return hunt_crossley;
    return rebound / (speed > kLeastSpeed ? speed : kLeastSpeed);
  }
  // k p^n, N. It is odd in p, so that the integrated function stays smooth where contact ends.
  double spring(double depth) const {
    const double p = std::abs(depth);
    const double power = exponent == 1.0   ? p
                         : exponent == 1.5 ? p * std::sqrt(p)
                         : exponent == 2.0 ? p * p
                                           : std::pow(p, exponent);
    return std::copysign(stiffness * power, depth);
  }
  // N. Contact ends where it becomes negative.
  double force(double depth, double rate, double a) const {
    return spring(depth) * (1.0 + a * rate) + damping * rate;
  }
  // N, positive exactly where the contact has a force, with a simple zero where it ends. scale: m,
  // > 0, typical penetration.
  double margin(double depth, double rate, double a, double scale) const {
    if (damping > 0.0) return force(depth, rate, a);
    const double per_depth = stiffness * std::pow(scale, exponent - 1.0);
    return per_depth * std::fmin(depth, scale * (1.0 + a * rate));
  }
};

}  // namespace rotorub
