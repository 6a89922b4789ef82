// Impacts with compression and expansion times: the balance of the energy, and the rows within
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/native_model/hard/rules.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"
#include "tests/support/two_rings.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;

constexpr double kTauC = 2e-4, kTauE = 3e-4;  // s

scene::Scene with_times(scene::Scene scene, double tau_c = kTauC, double tau_e = kTauE) {
  scene.first().contact->compression_time = tau_c;
  scene.first().contact->expansion_time = tau_e;
  return scene;
}

// Springs, dampers, a load and friction, which all do work during the impact.
scene::Scene loaded() {
  scene::Scene scene = make_scene({.mass = 2.0,
                                   .damping = 10.0,
                                   .stiffness = 5e4,
                                   .friction = 0.2,
                                   .restitution = 0.6,
                                   .speed = 150.0});
  test::add_constant_force(scene, {40.0, 10.0});
  scene.initial.vx = {0.3};
  scene.run.end = 0.03;
  return scene;
}

constexpr double kLoadedBalance = 1e-9;  // of the largest energy

// A scene made by hand may set the time of any of several contacts.
TEST(FiniteImpact, IsRefusedAtAnyContactByAnIntegratorWithoutIt) {
  for (const std::size_t k : {0u, 1u}) {
    scene::Scene scene = test::shaft_in_two_rings(2.0, 2.0, 1.0);
    scene.auxiliary[k].contact->expansion_time = kTauE;
    scene.run.end = 1e-3;
    const auto all = test::refusals([&] { test::run_with(scene, scene::Integrator::kEuler); });
    ASSERT_EQ(all.size(), 1u) << k;
    EXPECT_EQ(all[0].key, "contact.expansion_time") << k;
  }
}

// Without loads both phases have closed forms: compression stops the mass, expansion throws it
// back.
TEST(FiniteImpact, RowsWithinShowThePhases) {
  const double v = 0.3, eps = 0.5, mass = 2.0, delta = 0.5e-3, touch = delta / v;
  scene::Scene scene =
      with_times(make_scene({.mass = mass, .clearance = delta, .restitution = eps}));
  scene.initial.vx = {v};
  scene.run.end = 0.003;
  scene.run.output_times = {touch + 0.25 * kTauC, touch + 0.75 * kTauC,
                            touch + kTauC + 0.5 * kTauE};
  const Trajectory t = test::run_event(scene);
  const auto expect = [&](double time, double x, double vx, double force) {
    SCOPED_TRACE(time);
    const std::size_t k = test::row_of(t, time);
    ASSERT_LT(k, t.rows());
    EXPECT_NEAR(t.column("rotor_x")[k], x, 1e-15);
    EXPECT_NEAR(t.column("rotor_vx")[k], vx, 1e-12);
    EXPECT_NEAR(t.column("normal_force")[k], force, 1e-9);
  };
  expect(scene.run.output_times[0], delta, 0.75 * v, mass * v / kTauC);
  expect(scene.run.output_times[1], delta, 0.25 * v, mass * v / kTauC);
  expect(scene.run.output_times[2], delta - eps * v * 0.5 * kTauE, -0.5 * eps * v,
         eps * mass * v / kTauE);
  EXPECT_NEAR(t.statistics.contact_time, kTauC + kTauE, 1e-15) << "there was a normal force";
}

// The run ends within an impact: the state of that time, and the part of the impulse so far.
TEST(FiniteImpact, MayOutlastTheRun) {
  const double v = 0.3, eps = 0.5, mass = 2.0, delta = 0.5e-3, touch = delta / v;
  scene::Scene scene =
      with_times(make_scene({.mass = mass, .clearance = delta, .restitution = eps}));
  scene.initial.vx = {v};
  struct Case {
    double end, x, vx, impulse;
  };
  for (const Case& c : {Case{touch + 0.5 * kTauC, delta, 0.5 * v, 0.5 * mass * v},
                        Case{touch + kTauC + 0.25 * kTauE, delta - 0.25 * kTauE * eps * v,
                             -0.25 * eps * v, (1.0 + 0.25 * eps) * mass * v}}) {
    SCOPED_TRACE(c.end);
    scene.run.end = c.end;
    const Trajectory t = test::run_event(scene);
    EXPECT_EQ(t.end, c.end);
    EXPECT_EQ(t.column("t").back(), c.end);
    EXPECT_NEAR(t.column("rotor_x").back(), c.x, 1e-15);
    EXPECT_NEAR(t.column("rotor_vx").back(), c.vx, 1e-12);
    ASSERT_EQ(t.impacts.size(), 1u);
    EXPECT_NEAR(t.impacts[0].normal_impulse, c.impulse, 1e-12);
    EXPECT_LT(t.statistics.energy_residual(), kLoadedBalance);
  }
}

// The mark on the shaft passes the probe during a phase of the impact, after a quarter of it.
TEST(FiniteImpact, TheMarkPassesWithinIt) {
  const double v = 0.3, eps = 0.5, delta = 0.5e-3, touch = delta / v;
  struct Case {
    double time, x;
  };
  for (const Case& c : {Case{touch + 0.25 * kTauC, delta},
                        Case{touch + kTauC + 0.25 * kTauE, delta - 0.25 * kTauE * eps * v}}) {
    SCOPED_TRACE(c.time);
    const double speed = 2.0 * std::numbers::pi / c.time;
    scene::Scene scene =
        with_times(make_scene({.clearance = delta, .restitution = eps, .speed = speed}));
    scene.initial.vx = {v};
    scene.run.end = 1.5 * c.time;
    const Trajectory t = test::run_event(scene);
    ASSERT_EQ(t.keyphasor.size(), 1u);
    EXPECT_NEAR(t.keyphasor[0].t, c.time, 1e-15);
    EXPECT_NEAR(t.keyphasor[0].x, c.x, 1e-15);
    EXPECT_EQ(t.keyphasor[0].spin_speed, speed);
  }
}

// A force that ends within an impact acts until the impact's end: (16) holds the loads. The rows
// continue, and the balance closes.
TEST(FiniteImpact, PassesABreak) {
  scene::Scene scene = with_times(loaded());
  const Trajectory without = test::run_event(scene);
  ASSERT_GE(without.impacts.size(), 1u);
  scene.forces[0].off = without.impacts[0].t + 0.4 * kTauC;
  scene.run.output_times = {without.impacts[0].t + 0.5 * kTauC};
  const Trajectory t = test::run_event(scene);
  EXPECT_NEAR(t.impacts[0].normal_impulse, without.impacts[0].normal_impulse, 1e-10);
  EXPECT_LT(t.statistics.energy_residual(), kLoadedBalance);
  test::expect_finite(t);
}

// The peak and mean square of the force are those of an impulse spread over its phase.
TEST(FiniteImpact, SpreadsItsForceOverTheBins) {
  const double v = 0.3, mass = 2.0, delta = 0.5e-3;
  scene::Scene scene = with_times(make_scene({.mass = mass, .clearance = delta}), 1e-3, 0.0);
  scene.initial.vx = {v};
  scene.run.end = 0.004;
  scene.run.step = 1e-5;
  const Trajectory t = test::run_event(scene);
  EXPECT_NEAR(t.statistics.peak_force, mass * v / 1e-3, 1e-6);
}

// 400 N for good: Poisson's law would return a share of what the loads compress, and above some
// restitution bounce without end. Contact comes to rest, with the impacts of a series that falls
// off with eps_N.
TEST(FiniteImpact, ALoadedContactComesToRest) {
  constexpr double kForce = 400.0;
  for (const double eps : {0.3, 0.49, 0.51, 0.8, 0.95}) {
    for (const double tau_e : {0.0, 2e-5}) {
      SCOPED_TRACE(std::to_string(eps) + " " + std::to_string(tau_e));
      scene::Scene scene = with_times(make_scene({.mass = 1.0, .restitution = eps}), 2e-5, tau_e);
      test::add_constant_force(scene, {kForce, 0.0});
      scene.run.end = 0.3;
      for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
        const Trajectory t = test::run_with(scene, integrator, 5e-6);
        EXPECT_NEAR(t.column("normal_force").back(), kForce, 1e-6 * kForce);
        // From v = 0.63 m/s down to a duration's flight.
        EXPECT_LT(static_cast<double>(t.impacts.size()), 12.0 + 6.0 / -std::log(eps));
        for (const Impact& i : t.impacts) EXPECT_LE(i.energy_change, 0.0);
        const bool exact = integrator == scene::Integrator::kEvent;
        EXPECT_LT(t.statistics.energy_residual(), exact ? kLoadedBalance : 1e-2);
      }
    }
  }
}

// ---------------------------------------------------------------- what the residual is relative to
// The residual of the energy balance is relative to the largest energy of the run, wherever it was.

constexpr double kBalance = 1e-10;

// From rest, pushed, and back to rest: at both ends the energy is almost 0.
TEST(EnergyScale, IsThatOfThePushThatIsOver) {
  scene::Scene scene =
      test::make_scene({.mass = 2.0, .damping = 400.0, .stiffness = 2e5, .clearance = 1.0});
  test::add_constant_force(scene, {100.0, 0.0});
  scene.forces[0].off = 0.05;
  scene.run.end = 0.5;
  const Trajectory t = test::run_event(scene);
  const double stored = 0.5 * 100.0 * 100.0 / 2e5;
  EXPECT_GT(t.statistics.energy_scale, stored);
  EXPECT_LT(t.statistics.energy_residual(), kBalance);
}

// An impact at the first instant belongs to the run.
TEST(EnergyScale, TheImpactOfTheStartIsBooked) {
  for (const double tau : {0.0, 1e-4}) {
    SCOPED_TRACE(tau);
    scene::Scene scene = test::make_scene(
        {.mass = 2.0, .stiffness = 2e5, .friction = 0.2, .restitution = 0.5, .speed = 100.0});
    scene.first().contact->compression_time = tau;
    scene.initial.x = {0.5e-3};
    scene.initial.vx = {0.4};
    scene.run.end = 0.01;
    const Trajectory t = test::run_event(scene);
    ASSERT_GE(t.impacts.size(), 1u);
    EXPECT_EQ(t.impacts[0].t, 0.0);
    EXPECT_NEAR(t.statistics.energy_start, 0.5 * 2.0 * 0.16 + 0.5 * 2e5 * 0.25e-6, 1e-12);
    EXPECT_LT(t.statistics.energy_residual(), kBalance);
  }
}

}  // namespace
}  // namespace rotorub
