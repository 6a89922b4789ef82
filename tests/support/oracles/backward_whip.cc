#include "tests/support/oracles/backward_whip.h"

#include <cmath>
#include <limits>

namespace rotorub::oracle {
namespace {

// nu' = mu (nu - high)(nu - low), roots of the Riccati right-hand side.
struct Roots {
  double high, low;
};

Roots roots(const BackwardWhip& w) {
  const double d = w.damping;
  const double root = std::sqrt(d * d + 4.0 * w.friction * w.friction * w.mass * w.stiffness);
  return {(d + root) / (2.0 * w.friction * w.mass), (d - root) / (2.0 * w.friction * w.mass)};
}

}  // namespace

double BackwardWhip::natural_frequency() const { return std::sqrt(stiffness / mass); }
double BackwardWhip::growth_threshold() const { return roots(*this).high; }

double BackwardWhip::whirl_speed(double start, double t) const {
  // (nu - high) / (nu - low) = C e^{mu (high - low) t}.
  const auto [high, low] = roots(*this);
  const double c = (start - high) / (start - low) * std::exp(friction * (high - low) * t);
  return (high - low * c) / (1.0 - c);
}

double BackwardWhip::blow_up(double start) const {
  const auto [high, low] = roots(*this);
  if (start <= high) return std::numeric_limits<double>::infinity();
  return std::log((start - low) / (start - high)) / (friction * (high - low));
}

double BackwardWhip::normal_force(double nu) const {
  const double w = natural_frequency();
  return mass * clearance * (nu * nu - w * w);
}

}  // namespace rotorub::oracle
