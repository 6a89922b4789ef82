// A rotor in a ring with compliant contact on a moving base, in inertial coordinates. It is written
// only from the equations, with fixed steps of the classical fourth-order Runge-Kutta method, and
// uses no code of the native model.
//
//   m x'' = -k (x - u) - d (x' - u') + f(t) - N e_r + T e_t,   m, k, d: of the rotor x
//   M z'' = -K (z - u) - D (z' - u')        + N e_r - T e_t,   M, K, D: of the ring z
//
//   p = |x - z| - delta_0,   N = max(0, k_c p^n (1 + a p')) while p > 0,   T = -mu N sign(slip)
//
// u(t) is the position of the base, e_r the unit vector of x - z, and e_t is e_r turned by a
// quarter turn. The spin is held, slip = e_t . (x' - z') + r Omega. Each contact has its own a,
// from the speed v at which it begins, at least 0.1 mm/s:
//
//   a v = y,   ln[(1 + y) / (1 - e y)] = y (1 + e)
//
// A step ends where p or 1 + a p' reaches 0, and at the breaks of u. Near p = 0 the steps are
// short, because p^n is not smooth for every n.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <vector>

namespace rotorub::oracle {

// x + i y.
using Plane = std::complex<double>;

// In inertial coordinates, or relative to the base.
struct Motion {
  Plane rotor, ring, rotor_rate, ring_rate;  // m, m, m/s, m/s

  Motion plus(double factor, const Motion& other) const {
    return {rotor + factor * other.rotor, ring + factor * other.ring,
            rotor_rate + factor * other.rotor_rate, ring_rate + factor * other.ring_rate};
  }
};

struct BaseMotion {
  Plane place, rate;  // m, m/s

  Motion of_both() const { return {place, place, rate, rate}; }
};

// y = a v for a restitution e in (0, 1], by bisection.
inline double rebound_number(double e) {
  if (e == 1.0) return 0.0;
  double low = 0.1 * (1.0 - e), high = 1.0 / e;
  for (int i = 0; i < 200; ++i) {
    const double y = 0.5 * (low + high);
    (std::log1p(y) - std::log1p(-e * y) < y * (1.0 + e) ? low : high) = y;
  }
  return low;
}

class StillMachine {
 public:
  struct Body {
    double mass, damping, stiffness;  // kg, N s/m, N/m
  };
  struct Contact {
    double clearance, radius;      // m
    double friction, restitution;  // 1
    double stiffness, exponent;    // N/m^n, 1
  };

  Body rotor{2.0, 40.0, 2e5}, ring{1.0, 200.0, 1e5};
  Contact contact{0.5e-3, 0.05, 0.2, 0.5, 1e6, 1.0};
  double speed = 310.0;  // rad/s
  std::function<Plane(double)> force = [](double) { return Plane(0.0); };
  std::function<BaseMotion(double)> base = [](double) { return BaseMotion{}; };
  std::vector<double> breaks;  // s, ascending: times at which the base's acceleration is not smooth

  // The motion at `end` (s), relative to the base, as is `start`, in steps of at most `longest`
  // (s).
  Motion at(double end, const Motion& start, double longest) {
    Motion y = start.plus(1.0, base(0.0).of_both());
    const double rebound = rebound_number(contact.restitution);
    double a = 0.0;
    Part part = Part::kFree;
    for (double t = 0.0; t < end;) {
      const auto after = [&](double h) { return runge_kutta(t, h, y, part, a); };
      double h = std::min({longest, end - t, near_the_surface(y, part), to_break(t)});
      Motion next = after(h);
      if (part_of(next, a) != part) {
        double low = 0.0, high = h;  // bounds of the time until the change
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + high);
          (part_of(after(middle), a) != part ? high : low) = middle;
        }
        h = high;
        next = after(h);
      }
      y = next;
      t += h;
      const Contacting now = contacting(y);
      least_slip_ = std::min(least_slip_, std::abs(now.slip));
      if (part_of(y, a) == part) continue;
      if (part == Part::kFree) {
        a = rebound / std::max(now.rate, 1e-4);
        ++touches_;
      }
      part = part_of(y, a);
    }
    return y.plus(-1.0, base(end).of_both());
  }

  int touches() const { return touches_; }
  double least_slip() const { return least_slip_; }  // m/s, absolute value

 private:
  // kLetGo: still penetrating, but separating too fast for a contact force.
  enum class Part { kFree, kPressing, kLetGo };
  struct Contacting {
    Plane radial;
    double depth, rate, slip;  // m, m/s, m/s
  };

  Contacting contacting(const Motion& y) const {
    const Plane apart = y.rotor - y.ring, closing = y.rotor_rate - y.ring_rate;
    const Plane radial = apart / std::abs(apart), along = closing * std::conj(radial);
    return {radial, std::abs(apart) - contact.clearance, along.real(),
            along.imag() + contact.radius * speed};
  }
  Part part_of(const Motion& y, double a) const {
    const Contacting c = contacting(y);
    if (c.depth <= 0.0) return Part::kFree;
    return 1.0 + a * c.rate > 0.0 ? Part::kPressing : Part::kLetGo;
  }
  // s, a step in which the depth changes by a fifth.
  double near_the_surface(const Motion& y, Part part) const {
    if (part == Part::kFree) return std::numeric_limits<double>::infinity();
    const Contacting c = contacting(y);
    return std::max(1e-10, 0.2 * std::abs(c.depth / c.rate));
  }
  double to_break(double t) const {  // s
    const auto next = std::upper_bound(breaks.begin(), breaks.end(), t);
    return next == breaks.end() ? std::numeric_limits<double>::infinity() : *next - t;
  }
  Motion rates(double t, const Motion& y, Part part, double a) const {
    const BaseMotion moved = base(t);
    const auto support = [&](const Body& b, const Plane& place, const Plane& rate) {
      return -b.stiffness * (place - moved.place) - b.damping * (rate - moved.rate);
    };
    Plane pushed = 0.0;  // N, contact force on the ring
    if (part == Part::kPressing) {
      const Contacting c = contacting(y);
      const double spring =
          std::copysign(contact.stiffness * std::pow(std::abs(c.depth), contact.exponent), c.depth);
      const double normal = spring * (1.0 + a * c.rate);
      const double tangential = -std::copysign(contact.friction, c.slip) * normal;
      pushed = c.radial * Plane(normal, -tangential);
    }
    return {y.rotor_rate, y.ring_rate,
            (support(rotor, y.rotor, y.rotor_rate) + force(t) - pushed) / rotor.mass,
            (support(ring, y.ring, y.ring_rate) + pushed) / ring.mass};
  }
  Motion runge_kutta(double t, double h, const Motion& y, Part part, double a) const {
    const Motion k1 = rates(t, y, part, a), k2 = rates(t + 0.5 * h, y.plus(0.5 * h, k1), part, a),
                 k3 = rates(t + 0.5 * h, y.plus(0.5 * h, k2), part, a),
                 k4 = rates(t + h, y.plus(h, k3), part, a);
    return y.plus(h / 6.0, k1).plus(h / 3.0, k2).plus(h / 3.0, k3).plus(h / 6.0, k4);
  }

  int touches_ = 0;
  double least_slip_ = std::numeric_limits<double>::infinity();
};

}  // namespace rotorub::oracle
