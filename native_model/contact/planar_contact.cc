#include "native_model/contact/planar_contact.h"

#include <cassert>
#include <cmath>

namespace rotorub {

namespace {

// Sliding with a slip of the given sign; the slip that results may have the other sign.
struct Sliding {
  double normal, slip;  // L_N, y_T
};
Sliding sliding(const Delassus& a, double b_n, double b_t, double mu_sign) {
  const double normal = sliding_normal(a, b_n, mu_sign);
  return {normal, b_t + (a.tn - mu_sign * a.tt) * normal};
}

// Tests every case, for matrices where the solution need not be unique. If the coefficient of the
// normal row is 0, the impulse is infinite or undefined, and the case is no solution.
CoulombSolution enumerate(const Delassus& a, double b_n, double b_t, double mu) {
  CoulombSolution found;
  found.solutions = 0;
  const auto take = [&found](ContactCase c, PlanarImpulse l) {
    if (!std::isfinite(l.normal)) return;
    const int before = found.solutions;
    if (before == 0) found = {l.normal, l.friction, c};
    found.solutions = before + 1;
  };
  if (b_n >= 0.0) take(ContactCase::kOpen, {0.0, 0.0});
  const PlanarImpulse stuck = sticking_impulse(a, b_n, b_t);
  if (stuck.normal > 0.0 && std::abs(stuck.friction) <= mu * stuck.normal) {
    take(ContactCase::kStick, stuck);
  }
  const Sliding positive = sliding(a, b_n, b_t, mu);
  if (positive.normal > 0.0 && positive.slip > 0.0) {
    take(ContactCase::kSlidePositive, {positive.normal, -mu * positive.normal});
  }
  const Sliding negative = sliding(a, b_n, b_t, -mu);
  if (negative.normal > 0.0 && negative.slip < 0.0) {
    take(ContactCase::kSlideNegative, {negative.normal, mu * negative.normal});
  }
  return found;
}

}  // namespace

CoulombSolution solve_coulomb(const Delassus& a, double b_n, double b_t, double mu) {
  assert(a.nn > 0.0 && a.tt > 0.0 && mu >= 0.0);
  // If a_nn > mu |a_nt| and the matrix is symmetric, exactly one case holds: sliding one way,
  // sliding the other way, or else sticking.
  if (a.nt != a.tn || mu * std::abs(a.nt) >= a.nn) return enumerate(a, b_n, b_t, mu);
  if (b_n >= 0.0) return {};
  const Sliding positive = sliding(a, b_n, b_t, mu);
  if (positive.slip > 0.0) {
    return {positive.normal, -mu * positive.normal, ContactCase::kSlidePositive};
  }
  const Sliding negative = sliding(a, b_n, b_t, -mu);
  if (negative.slip < 0.0) {
    return {negative.normal, mu * negative.normal, ContactCase::kSlideNegative};
  }
  const PlanarImpulse stuck = sticking_impulse(a, b_n, b_t);
  return {stuck.normal, stuck.friction, ContactCase::kStick};
}

CoulombSolution solve_coulomb(const Delassus& a, double b_n, double b_t, const FrictionLaw& law,
                              double before) {
  SlipFriction friction(law, before);
  for (;;) {
    const CoulombSolution s = solve_coulomb(a, b_n, b_t, friction.mu());
    const bool sticks = s.contact_case == ContactCase::kStick;
    const double slip = sticks ? 0.0 : slip_after(a, b_t, {s.normal, s.friction});
    if (!s.is_unique() || !friction.improve(slip, a.tt * s.normal)) return s;
  }
}

}  // namespace rotorub
