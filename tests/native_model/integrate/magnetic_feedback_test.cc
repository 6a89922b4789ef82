// A magnetic bearing that holds the rotor by a feedback of its own, against exact answers: its
// linear law, its current at the limit, the fall once it has failed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "native_model/rotor/campbell.h"
#include "native_model/system/model.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

using test::run_event;
using test::run_with;

using Complex = std::complex<double>;

constexpr double kHeld = 2.0, kNegative = 1e5;               // kg, N/m
constexpr double kForce = 80.0, kProportional = 4000.0;      // N/A, A/m
constexpr double kDerivative = 2.0;                          // A s/m
constexpr double kNet = kForce * kProportional - kNegative;  // N/m
constexpr double kGravity = 9.81;                            // m/s^2

// A rigid mode that nothing else holds.
scene::Scene levitated() {
  scene::Scene s = test::make_scene({.mass = kHeld, .clearance = 0.5e-3});
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, kNegative}};
  s.magnetic_bearings[0].control = scene::BearingControl{
      .force_per_current = kForce, .proportional = kProportional, .derivative = kDerivative};
  s.run.end = 0.05;
  s.run.output_step = 1e-3;
  return s;
}

// `event` to `share` of `size`; fixed steps of order 2. (Where the force has a kink, what a step
// makes of it depends on where in the step it falls: neighbours scatter.)
template <class Exact>
void expect_motion(const scene::Scene& s, double size, double share, double order,
                   const Exact& exact) {
  const Trajectory reference = run_event(s);
  EXPECT_LT(test::orbit_error(reference, exact), share * size);
  EXPECT_LT(reference.statistics.energy_residual(), 1e-9);
  test::Convergence c;
  for (const double step : {2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6}) {
    c.steps.push_back(step);
    c.errors.push_back(test::orbit_error(run_with(s, scene::Integrator::kVerlet, step), exact));
  }
  EXPECT_GT(c.order(), order) << " " << c.text();
  EXPECT_LT(c.errors.back(), 1e-3 * size) << c.text();
}

// m z'' + k_i D z' + (k_i P - k_s) z = 0.
TEST(MagneticFeedback, LinearLawIsASpringAndADamper) {
  scene::Scene s = levitated();
  s.initial.x = {1e-4};
  s.initial.vy = {0.03};
  const double delta = 0.5 * kForce * kDerivative / kHeld;
  const double omega = std::sqrt(kNet / kHeld - delta * delta);
  const Complex z0 = 1e-4, v0{0.0, 0.03};
  expect_motion(s, 1e-4, 1e-9, 1.95, [&](double t) {
    return std::exp(-delta * t) *
           (z0 * std::cos(omega * t) + (v0 + delta * z0) / omega * std::sin(omega * t));
  });
  // The same poles in `modes`.
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(s), 0.0);
  for (const auto& mode : spectrum.modes) {
    EXPECT_NEAR(std::abs(mode.frequency), omega, 1e-9 * omega);
    EXPECT_NEAR(mode.damping_ratio, delta / std::sqrt(kNet / kHeld), 1e-9);
  }
}

// The current as the linear law has it, and its force at the limit.
TEST(MagneticFeedback, CurrentIsAColumn) {
  scene::Scene s = levitated();
  s.initial.x = {1e-4};
  s.initial.vy = {0.03};
  s.magnetic_bearings[0].control->current_limit = 0.2;
  s.magnetic_bearings[0].control->fails_at = 0.0205;
  const Trajectory t = run_event(s);
  const auto current = [](double r, double rate) {
    return std::clamp(-(kProportional * r + kDerivative * rate), -0.2, 0.2);
  };
  bool limited = false, linear = false;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const bool works = t.column("t")[k] < 0.0205;
    const double x = current(t.column("rotor_x")[k], t.column("rotor_vx")[k]);
    const double y = current(t.column("rotor_y")[k], t.column("rotor_vy")[k]);
    EXPECT_EQ(t.column("bearing_current_x")[k], works ? x : 0.0) << k;
    EXPECT_EQ(t.column("bearing_current_y")[k], works ? y : 0.0) << k;
    limited = limited || std::abs(x) == 0.2;
    linear = linear || (x != 0.0 && std::abs(x) < 0.1);
  }
  EXPECT_TRUE(limited && linear);
  EXPECT_FALSE(run_event(test::make_scene({.stiffness = 2e5})).has("bearing_current_x"));
}

// At the limit I the force is constant: a parabola of -k_i I / m; once |P x| < I, the spring k_i P.
TEST(MagneticFeedback, AtTheLimitTheForceIsConstant) {
  constexpr double kLimit = 0.5, kStart = 4e-4;
  scene::Scene s = levitated();
  s.magnetic_bearings[0].negative_stiffness = 0.0;
  s.magnetic_bearings[0].control->derivative = 0.0;
  s.magnetic_bearings[0].control->current_limit = kLimit;
  s.initial.x = {kStart};
  const double a = kForce * kLimit / kHeld, border = kLimit / kProportional;
  const double reached = std::sqrt(2.0 * (kStart - border) / a), speed = -a * reached;
  const double omega = std::sqrt(kForce * kProportional / kHeld);
  const auto exact = [&](double t) -> Complex {
    if (t < reached) return kStart - 0.5 * a * t * t;
    const double since = t - reached;
    return border * std::cos(omega * since) + speed / omega * std::sin(omega * since);
  };
  s.run.output_step = 1e-4;
  s.run.end = 0.005;
  ASSERT_LT(s.run.end, reached);
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    EXPECT_LT(test::orbit_error(run_with(s, integrator), exact), 1e-12 * kStart)
        << static_cast<int>(integrator);
  }
  // Into the linear range: the current has a kink there, no jump.
  s.run.end = 0.006;
  ASSERT_LT(reached, 0.9 * s.run.end);
  expect_motion(s, kStart, 1e-9, 1.85, exact);
}

// With a damper the limit depends on the velocity too: a fixed step iterates, and is of order 2.
TEST(MagneticFeedback, FixedStepsAreOfSecondOrderThroughLimitAndFailure) {
  scene::Scene s = levitated();
  s.first().contact.reset();
  s.initial.x = {3e-4};
  s.initial.vy = {0.1};
  s.magnetic_bearings[0].control->current_limit = 0.4;
  s.magnetic_bearings[0].control->fails_at = 0.0312345678;
  const Trajectory reference = run_event(s);
  EXPECT_LT(reference.statistics.energy_residual(), 1e-10);
  test::Convergence c;
  for (const double step : {2e-4, 1e-4, 5e-5, 2.5e-5, 1e-5}) {
    const Trajectory t = run_with(s, scene::Integrator::kVerlet, step);
    c.steps.push_back(step);
    c.errors.push_back(test::rotor_error(t, reference));
  }
  EXPECT_GT(c.order(), 1.85) << " " << c.text();
  EXPECT_LT(run_with(s, scene::Integrator::kVerlet).statistics.energy_residual(), 1e-5);
}

// It fails: from where it hung the rotor falls freely, to the ring.
TEST(MagneticFeedback, FailsAndTheRotorFalls) {
  constexpr double kFails = 3.3e-3;
  scene::Scene s = levitated();
  s.first().contact->restitution = 0.5;
  s.gravity = scene::Gravity{{0.0, -kGravity}, {}};
  s.initial.steady = true;
  s.magnetic_bearings[0].control->fails_at = kFails;
  s.run.output_step = 1e-4;
  const double sag = kHeld * kGravity / kNet, fall = s.first().contact->clearance - sag;
  const double touch = kFails + std::sqrt(2.0 * fall / kGravity);
  s.run.end = touch - 1e-4;
  const auto exact = [&](double t) {
    const double since = std::max(0.0, t - kFails);
    return Complex(0.0, -sag - 0.5 * kGravity * since * since);
  };
  EXPECT_LT(test::orbit_error(run_event(s), exact), 1e-9 * s.first().contact->clearance);
  s.run.end = touch + 1e-3;
  const Trajectory t = run_event(s);
  ASSERT_FALSE(t.impacts.empty());
  EXPECT_NEAR(t.impacts[0].t, touch, 1e-9 * touch);
  EXPECT_NEAR(t.impacts[0].gap_rate_before, -std::sqrt(2.0 * kGravity * fall), 1e-9);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);
  const Trajectory stepped = run_with(s, scene::Integrator::kVerlet);
  ASSERT_FALSE(stepped.impacts.empty());
  EXPECT_NEAR(stepped.impacts[0].t, touch, 1e-5);
}

}  // namespace
}  // namespace rotorub
