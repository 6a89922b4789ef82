// Exact: a bounce of one impact a turn, without friction.
//
//   m x'' = F + A cos(Omega t) towards the ring, x <= delta_0,
//
// because two forces that turn in opposite senses swing along x. The speed before the impact is
// w = F T / (m (1 + eps)), and its phase has sin(Omega t) = pi F (1 - eps) / (A (1 + eps)) (P. J.
// Holmes, J. Sound Vib. 84, 1982). With a = (F + A cos) / m at the impact, small changes have the
// multipliers
//
//   along x   s^2 - ((1 + eps) a T / w - 2 eps) s + eps^2 = 0
//   along y   s^2 - (2 - (1 + eps) w T / delta_0) s + 1 = 0, by the curvature of the ring.
//
// So the bounce begins in a fold, s = 1, at A = pi F (1 - eps) / (1 + eps), where cos = 0, and
// doubles its period, s = -1, where A cos = -F (1 + ((1 - eps) / (1 + eps))^2).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/jeffcott.h"

namespace rotorub::periodic {
inline constexpr double kTurn = 2.0 * std::numbers::pi;  // rad
}

namespace rotorub::test {

struct BounceOnceATurn {
  double mass = 2.0, omega = 300.0;            // kg, rad/s
  double press = 10.0, swing = 12.5;           // N, F and A
  double restitution = 0.5, clearance = 2e-3;  // 1, m

  double period() const { return 2.0 * std::numbers::pi / omega; }
  double approach() const { return press * period() / (mass * (1.0 + restitution)); }  // m/s, w
  double least_swing() const {  // N, at the fold
    return std::numbers::pi * press * (1.0 - restitution) / (1.0 + restitution);
  }
  double doubling_swing() const {  // N, at the period doubling
    const double share = (1.0 - restitution) / (1.0 + restitution);
    return std::hypot(least_swing(), press * (1.0 + share * share));
  }
  double phase() const { return std::numbers::pi - std::asin(least_swing() / swing); }
  double acceleration() const { return (press + swing * std::cos(phase())) / mass; }  // a
  // At t = 0, after the impact of the turn before: m, m/s.
  double x() const {
    const double after = period() - phase() / omega, sine = std::sin(phase());
    return clearance - restitution * approach() * after + 0.5 * press / mass * after * after +
           swing / mass / omega * ((std::cos(phase()) - 1.0) / omega - after * sine);
  }
  double v() const {
    const double after = period() - phase() / omega;
    return -restitution * approach() + press / mass * after -
           swing / mass / omega * std::sin(phase());
  }
  // The flight after an impact at the time s with the speed w: how far it is from the next impact
  // at the time t with the speed w_next, in m and m/s.
  double flight_error(double s, double w, double t, double w_next) const {
    const double flown = t - s, sine = std::sin(omega * s);
    const double at =
        -restitution * w * flown + 0.5 * press / mass * flown * flown +
        swing / mass / omega * ((std::cos(omega * s) - std::cos(omega * t)) / omega - flown * sine);
    const double speed = -restitution * w + press / mass * flown +
                         swing / mass / omega * (std::sin(omega * t) - sine);
    return std::max(std::abs(at), std::abs(speed - w_next));
  }
  scene::Scene scene() const {
    scene::Scene s = make_scene(
        {.mass = mass, .clearance = clearance, .restitution = restitution, .speed = omega});
    add_constant_force(s, {press, 0.0});
    add_rotating_force(s, 0.5 * swing, omega);
    add_rotating_force(s, 0.5 * swing, -omega);
    s.initial.x = {x()};
    s.initial.vx = {v()};
    return s;
  }
};

}  // namespace rotorub::test
