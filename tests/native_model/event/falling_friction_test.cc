// Friction that falls with slip, in `event` and by fixed steps, against equations of its own: a
// free rotor on the bottom of a rigid ring under a constant load W, at the angle theta from there,
//
//   N = W cos(theta) + m delta theta'^2,   v = r Omega + delta theta'
//   m delta theta'' = -W sin(theta) - mu(|v|) N sign(v),   J Omega' = -r mu(|v|) N sign(v)
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "native_model/scene/scene.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"
#include "tests/support/runge_kutta.h"

namespace rotorub {
namespace {

constexpr double kMass = 2.0, kInertia = 2e-3, kLoad = 40.0;  // kg, kg m^2, N
constexpr double kRadius = 0.05, kClearance = 0.5e-3;         // m

// Written out here without the product's law.
double mu(double v) {
  v = std::abs(v);
  return 0.15 + 0.12 * std::exp(-(v / 0.3) * (v / 0.3)) + 0.03 * v;
}
FrictionLaw law() {
  FrictionLaw f = 0.15;
  f.excess = 0.12;
  f.stribeck_speed = 0.3;
  f.viscous = 0.03;
  return f;
}

scene::Scene spinning_down(double speed) {
  scene::Scene s = test::make_scene({.mass = kMass, .speed = speed});
  s.rotor.modal->inertia = kInertia;
  s.first().contact->friction = law();
  s.drive = scene::Drive{};
  s.drive->kind = scene::DriveKind::kFree;
  test::add_constant_force(s, {0.0, -kLoad});
  s.initial.y = {-kClearance};
  s.run.end = 0.02;
  s.run.output_step = 1e-3;
  return s;
}

// (theta, theta', Omega)
Eigen::VectorXd rate(double /*t*/, const Eigen::VectorXd& y) {
  const double v = kRadius * y[2] + kClearance * y[1];
  const double normal = kLoad * std::cos(y[0]) + kMass * kClearance * y[1] * y[1];
  const double friction = -mu(v) * normal * (v > 0.0 ? 1.0 : -1.0);
  Eigen::VectorXd dy(3);
  dy << y[1], (friction - kLoad * std::sin(y[0])) / (kMass * kClearance),
      kRadius * friction / kInertia;
  return dy;
}
Eigen::VectorXd exact(double speed, double t) {
  return test::runge_kutta(rate, 0.0, t, 20000, Eigen::Vector3d(0.0, 0.0, speed));
}

TEST(FallingFriction, SpinsDownAsItsOwnEquationsSay) {
  for (const double sense : {1.0, -1.0}) {
    const double speed = 40.0 * sense;  // it slides throughout
    const scene::Scene s = spinning_down(speed);
    const Eigen::VectorXd y = exact(speed, s.run.end);
    const Trajectory t = test::run_event(s);
    EXPECT_TRUE(t.impacts.empty());
    EXPECT_LT(y[2] * sense, 0.9 * 40.0) << "it was braked";
    EXPECT_NEAR(t.column("spin_speed").back(), y[2], 1e-9 * 40.0);
    EXPECT_NEAR(t.column("rotor_x").back(), kClearance * std::sin(y[0]), 1e-9 * kClearance);
    EXPECT_LT(t.statistics.energy_residual(), 1e-9);
  }
}

// Steps with mu of the middle are of second order, those with mu of the end of first.
TEST(FallingFriction, EachSchemeKeepsItsOrder) {
  const scene::Scene s = spinning_down(40.0);
  const Trajectory reference = test::run_event(s);
  for (const auto& [integrator, least] :
       {std::pair{scene::Integrator::kVerlet, 1.9}, std::pair{scene::Integrator::kEuler, 0.9}}) {
    test::Convergence c;
    for (const double step : {1e-4, 5e-5, 2.5e-5, 1.25e-5, 6.25e-6}) {
      const Trajectory t = test::run_with(s, integrator, step);
      c.steps.push_back(step);
      c.errors.push_back(test::trajectory_error(t, reference, kRadius));
    }
    EXPECT_GE(c.order(), least) << static_cast<int>(integrator) << ' ' << c.text();
  }
}

// At rest under a load W down and a growing load across, it slides when that reaches mu(0) W, at
// the exact instant.
TEST(FallingFriction, SticksUpToStatic) {
  for (const double sense : {1.0, -1.0}) {
    scene::Scene s = test::make_scene({.mass = kMass});
    s.first().contact->friction = law();
    test::add_constant_force(s, {0.0, -kLoad});
    test::add_constant_force(s, {sense * kLoad, 0.0});
    s.forces[1].ramp = 0.1;
    s.initial.y = {-kClearance};
    s.run.end = 0.04;
    const Trajectory t = test::run_event(s);
    ASSERT_EQ(t.events.size(), 2U);
    EXPECT_EQ(t.events[0].kind, EventKind::kStick);
    EXPECT_EQ(t.events[1].kind, EventKind::kSlide);
    EXPECT_NEAR(t.events[1].t, 0.1 * mu(0.0), 1e-12);
    for (const scene::Integrator i : {scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
      const Trajectory fixed = test::run_with(s, i, 1e-5);
      ASSERT_FALSE(fixed.events.empty());
      EXPECT_NEAR(fixed.events.back().t, 0.1 * mu(0.0), 2.1e-5) << fixed.integrator;
    }
  }
}

// While it swings on the bottom, the slip reverses with mu(0) on either side.
TEST(FallingFriction, ReversesInEveryScheme) {
  scene::Scene s = test::make_scene({.mass = kMass});
  s.first().contact->friction = law();
  test::add_constant_force(s, {0.0, -kLoad});
  const double start = 1.2;
  s.initial.x = {kClearance * std::sin(start)};
  s.initial.y = {-kClearance * std::cos(start)};
  s.run.end = 0.1;
  s.run.output_step = 1e-3;
  const Trajectory exact = test::run_event(s);
  EXPECT_GT(std::count_if(exact.events.begin(), exact.events.end(),
                          [](const Event& e) { return e.kind == EventKind::kReverse; }),
            0);
  EXPECT_EQ(exact.column("mode").back(), static_cast<double>(ContactMode::kStick));
  for (const auto& [integrator, least] :
       {std::pair{scene::Integrator::kVerlet, 1.8}, std::pair{scene::Integrator::kEuler, 0.9}}) {
    test::Convergence c;
    for (const double step : {5e-5, 2.5e-5, 1.25e-5, 6.25e-6, 3.125e-6}) {
      c.steps.push_back(step);
      c.errors.push_back(test::rotor_error(test::run_with(s, integrator, step), exact));
    }
    EXPECT_GE(c.order(), least) << static_cast<int>(integrator) << ' ' << c.text();
  }
}

// A Stribeck speed far below every slip makes friction jump: it costs steps, and does no harm.
TEST(FallingFriction, ATinyStribeckSpeedIsNoHarm) {
  for (const double stribeck : {1e-3, 1e-6, 1e-12}) {
    scene::Scene s = spinning_down(4.0);
    s.first().contact->friction.stribeck_speed = stribeck;
    s.run.end = 0.1;
    const Trajectory t = test::run_event(s);
    for (const scene::Integrator i : {scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
      const Trajectory fixed = test::run_with(s, i, 1e-5);
    }
  }
}

}  // namespace
}  // namespace rotorub
