// A contact that gives. Of the depth p = |d| - delta_0 (m) of the rotor in the wall of the ring and
// its rate p' = -gdot_N, while it presses (N > 0):
//
//   N = k p^n (1 + a p')     Hunt and Crossley, J. Appl. Mech. 42 (1975) 440; n = 1 is a line
//                            contact, 3/2 Hertz's
//   N = k p + c p'           n = 1, a spring and a damper
//
// Where a scene gives neither a nor c, each touch has the a with which free masses that meet at v
// rebound with `restitution` e, whatever k and n:
//
//   ln[(1 + a v) / (1 - a e v)] = a v (1 + e)
//
// a v is one number for each e: 0 for e = 1, and 1/e for small e. It has a limit, as e = 0 has
// none, and v a least one, as a would grow without bound for a touch that grazes. A contact that
// begins closed has a = 0: it is loaded, not struck, and no touch has a speed (begins_closed).
//
// Friction is Coulomb's of this N, sticking without any give.
#pragma once

#include <cmath>
#include <optional>

namespace rotorub {

// [contact.compliance]
struct Compliance {
  double stiffness = 0.0;                    // N/m^n, > 0, k
  double exponent = 1.0;                     // 1, in [1, 2], n
  std::optional<double> hunt_crossley = {};  // s/m, >= 0, a
  std::optional<double> damping = {};        // N s/m, >= 0, c; with n = 1 alone

  bool by_restitution() const { return !hunt_crossley && !damping; }
};

// As the models have it. A stiffness of 0: the contact is rigid.
struct CompliantLaw {
  // a v of a restitution in [0, 1], at most kMostRebound: 0.01 is the least that is met.
  static constexpr double kMostRebound = 100.0;
  static double rebound_of(double restitution);
  // m/s: slower touches have the a of this one.
  static constexpr double kLeastSpeed = 1e-4;

  double stiffness = 0.0, exponent = 1.0;  // N/m^n, n
  double damping = 0.0;                    // N s/m, c
  double hunt_crossley = 0.0;              // s/m, a of every touch, where it is given
  double rebound = 0.0;                    // a v, where the restitution says it

  CompliantLaw() = default;
  CompliantLaw(const Compliance& of, double restitution)
      : stiffness(of.stiffness),
        exponent(of.exponent),
        damping(of.damping.value_or(0.0)),
        hunt_crossley(of.hunt_crossley.value_or(0.0)),
        rebound(of.by_restitution() ? rebound_of(restitution) : 0.0) {}

  bool gives() const { return stiffness > 0.0; }

  // Whether a contact is closed in a state that no motion led to (a start, a reset, a keyframe, a
  // state that is written): in the wall, whatever its speed, or at rest on the circle. gap,
  // clearance: m; gap_rate: m/s.
  static constexpr double kOnCircle = 1e-12;  // of the clearance: a gap that counts as 0
  static constexpr double kAtRest = 1e-9;     // m/s: a gap rate that counts as 0
  static bool begins_closed(double gap, double gap_rate, double clearance) {
    const double round_off = kOnCircle * clearance;
    return gap < -round_off || (gap <= round_off && std::abs(gap_rate) <= kAtRest);
  }
  // s/m, of a contact that begins closed: the a that is given, or 0.
  double a_of_start() const { return hunt_crossley; }
  // s/m, of a touch at this speed, m/s.
  double a_of_touch(double speed) const {
    if (rebound == 0.0 || speed <= 0.0) return hunt_crossley;
    return rebound / (speed > kLeastSpeed ? speed : kLeastSpeed);
  }
  // k p^n, N; odd in p, so that what is integrated stays smooth where contact ends.
  double spring(double depth) const {
    const double p = std::abs(depth);
    const double power = exponent == 1.0   ? p
                         : exponent == 1.5 ? p * std::sqrt(p)
                         : exponent == 2.0 ? p * p
                                           : std::pow(p, exponent);
    return std::copysign(stiffness * power, depth);
  }
  // N; negative where the contact has ended.
  double force(double depth, double rate, double a) const {
    return spring(depth) * (1.0 + a * rate) + damping * rate;
  }
  // Positive exactly where the force is, and of first order where it ends; N. `scale`: m, > 0, of
  // the depths in question.
  double margin(double depth, double rate, double a, double scale) const {
    if (damping > 0.0) return force(depth, rate, a);
    const double per_depth = stiffness * std::pow(scale, exponent - 1.0);
    return per_depth * std::fmin(depth, scale * (1.0 + a * rate));
  }
};

}  // namespace rotorub
