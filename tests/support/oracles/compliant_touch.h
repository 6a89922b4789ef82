// A free, spinning rotor in a fixed ring with compliant contact, written only from the equations:
// fixed steps of the classical fourth-order Runge-Kutta method, shortened where the contact state
// changes.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "tests/support/runge_kutta.h"

namespace rotorub::oracle {

struct CompliantTouch {
  double mass = 2.0, inertia = 2e-3;         // kg, kg m^2
  double clearance = 0.5e-3, radius = 0.05;  // m
  double stiffness = 1e7, exponent = 1.0;    // N/m^n, n
  double a = 0.0, friction = 0.0;            // s/m, mu
  mutable double stuck = 0.0;                // s, total time of sticking

  using State = Eigen::VectorXd;  // x, y, vx, vy, spin

  enum class Case { kFree, kForward, kBackward, kStuck };

  double depth(const State& s) const { return std::hypot(s[0], s[1]) - clearance; }
  double slip(const State& s) const {
    return (s[0] * s[3] - s[1] * s[2]) / std::hypot(s[0], s[1]) + radius * s[4];
  }
  double normal(const State& s) const {
    const double p = depth(s), rate = (s[0] * s[2] + s[1] * s[3]) / std::hypot(s[0], s[1]);
    return std::copysign(stiffness * std::pow(std::abs(p), exponent), p) * (1.0 + a * rate);
  }
  // d/dt slip = T (1/m + r^2/J) - v_r v_t / |r|, with v_r and v_t the radial and tangential
  // velocity.
  double sticking(const State& s) const {
    const double r = std::hypot(s[0], s[1]), along = (s[0] * s[2] + s[1] * s[3]) / r,
                 across = (s[0] * s[3] - s[1] * s[2]) / r;
    return along * across / r / (1.0 / mass + radius * radius / inertia);
  }
  double tangential(const State& s, Case c) const {
    switch (c) {
      case Case::kFree:
        return 0.0;
      case Case::kForward:
        return -friction * normal(s);
      case Case::kBackward:
        return friction * normal(s);
      case Case::kStuck:
        return sticking(s);
    }
    return 0.0;
  }
  State rate(const State& s, Case c) const {
    State d(5);
    d << s[2], s[3], 0.0, 0.0, 0.0;
    if (c == Case::kFree) return d;
    const double r = std::hypot(s[0], s[1]), n = normal(s), t = tangential(s, c);
    d[2] = (-n * s[0] / r - t * s[1] / r) / mass;
    d[3] = (-n * s[1] / r + t * s[0] / r) / mass;
    d[4] = radius * t / inertia;
    return d;
  }
  // Positive while the state lasts.
  double margin(const State& s, Case c) const {
    if (c == Case::kFree) return -depth(s);
    if (depth(s) < 0.0) return depth(s);
    if (c == Case::kForward) return slip(s);
    if (c == Case::kBackward) return -slip(s);
    return friction * normal(s) - std::abs(sticking(s));
  }
  Case next(const State& s, Case c) const {
    if (c == Case::kFree) return slip(s) > 0.0 ? Case::kForward : Case::kBackward;
    if (depth(s) <= 1e-14) return Case::kFree;
    if (c != Case::kStuck && std::abs(sticking(s)) <= friction * normal(s)) return Case::kStuck;
    return sticking(s) > 0.0 ? Case::kBackward : Case::kForward;
  }
  State at(double end, std::initializer_list<double> start, int steps) const {
    State s = Eigen::Map<const State>(start.begin(), static_cast<Eigen::Index>(start.size()));
    Case c = Case::kFree;
    const double most = end / steps;
    for (double t = 0.0; t < end;) {
      const auto step = [&](double h) {
        return test::runge_kutta([&](double, const State& y) { return rate(y, c); }, t, h, s);
      };
      double h = std::min(most, end - t);
      State after = step(h);
      const bool ends = margin(after, c) < 0.0;
      if (ends) {  // shortens the step to the change of state, by bisection
        double low = 0.0, high = h;
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + high);
          (margin(step(middle), c) < 0.0 ? high : low) = middle;
        }
        h = high;
        after = step(h);
      }
      if (c == Case::kStuck) stuck += h;
      s = after;
      if (ends) c = next(s, c);
      t += h;
    }
    return s;
  }
};

}  // namespace rotorub::oracle
