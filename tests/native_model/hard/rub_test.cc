// Lasting contact in hard cases: friction from little to absurd, unusual spin and mass, more than
// one attractor, stick-slip.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "native_model/oracles/annular_rub.h"
#include "native_model/prepare/prepare.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/elastic_whip.h"
#include "tests/support/whip.h"

namespace rotorub {
namespace {

using oracle::ElasticWhip;
using test::Jeffcott;
using test::make_scene;

scene::Scene ring_scene(double end) {
  scene::Scene scene = test::shipped("bench_ring");
  scene.run.end = end;
  return scene;
}

double fastest(const Trajectory& t) {
  return 2.0 *
         std::max({1.0, test::largest(t.column("rotor_vx")), test::largest(t.column("rotor_vy")),
                   test::largest(t.column("stator_vx")), test::largest(t.column("stator_vy"))});
}

void expect_both_sound(const scene::Scene& scene, double step) {
  test::sound_event(scene);
  const Trajectory p = test::run_verlet(scene, step);
  test::expect_sound_verlet(scene, p, step, fastest(p));
}

TEST(HardFriction, FromATenthToTen) {
  for (const double mu : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    SCOPED_TRACE(mu);
    scene::Scene scene = ring_scene(0.05);
    scene.first().contact->friction = mu;
    expect_both_sound(scene, 1e-5);
    scene.first().contact->tangential_restitution = 0.5;
    expect_both_sound(scene, 1e-5);
  }
}

TEST(HardSpin, ToAHundredThousand) {
  for (const double speed : {1e3, 1e4, 1e5, -1e5}) {
    for (const bool free : {true, false}) {
      SCOPED_TRACE(speed);
      scene::Scene scene = ring_scene(0.03);
      scene.rotor.speed = speed;
      scene.drive->speed = speed;
      if (!free) scene.drive.reset();
      expect_both_sound(scene, 1e-5);
    }
  }
}

TEST(HardMassRatio, RingFromATenThousandthToTenThousandRotors) {
  for (const double ratio : {1e-4, 1e-2, 1e2, 1e4}) {
    SCOPED_TRACE(ratio);
    scene::Scene scene = ring_scene(0.03);
    const double m = 2.0 * ratio, k = m * 1e5;  // the same natural frequency throughout
    scene.first().stator =
        scene::Stator{{m, m}, {0.3 * std::sqrt(k * m), 0.3 * std::sqrt(k * m)}, {k, k}};
    expect_both_sound(scene, 1e-5);
  }
}

// A mode that the step cannot resolve is refused before the first step, with the limit in the
// message; `event` accepts it.
TEST(HardStiffModes, RefusedOrSolved) {
  scene::Scene scene = ring_scene(0.01);
  scene.rotor.modal->mass = {2.0, 1e-3};
  scene.rotor.modal->stiffness = {2e5, 1e9};  // 1e6 rad/s
  scene.rotor.modal->damping = {40.0, 100.0};
  scene.rotor.modal->internal_damping = scene.rotor.modal->gyroscopic = {0.0, 0.0};
  for (auto* list : {&scene.rotor.modal->mass_y, &scene.rotor.modal->stiffness_y,
                     &scene.rotor.modal->damping_y}) {
    list->clear();
  }
  scene.rotor.modal->mass_y = scene.rotor.modal->mass;
  scene.rotor.modal->stiffness_y = scene.rotor.modal->stiffness;
  scene.forces[0].shape = {1.0, 1.0};
  scene.rotor.modal->damping_y = scene.rotor.modal->damping;
  for (const double step : {1e-5, 2.01e-6}) {
    const Trajectory t = test::attempt_with(scene, scene::Integrator::kVerlet, step);
    EXPECT_EQ(t.status, Status::kStepTooLarge);
    EXPECT_NE(t.message.find("the limit of"), std::string::npos) << t.message;
    EXPECT_EQ(t.steps, 0);
    test::expect_finite(t);
  }
  const Trajectory p = test::run_verlet(scene, 1e-6);
  test::expect_sound_verlet(scene, p, 1e-6, fastest(p));
  const Trajectory t = test::sound_event(scene);
  EXPECT_LT(std::hypot(p.column("rotor_x").back() - t.column("rotor_x").back(),
                       p.column("rotor_y").back() - t.column("rotor_y").back()),
            1e-5);
}

// A rotor that is driven through sticking: phases of stick last and do not flicker.
TEST(HardStickSlip, NoChangeOfSignEveryStep) {
  scene::Scene scene = make_scene({.mass = 2.0,
                                   .damping = 20.0,
                                   .stiffness = 1e4,
                                   .friction = 0.4,
                                   .restitution = 0.0,
                                   .speed = 0.0});
  test::add_constant_force(scene, {0.0, -60.0});  // held on the ring
  scene::Force shaking;
  shaking.kind = scene::ForceKind::kRotating;
  shaking.amplitude = 30.0;
  shaking.frequency = 200.0;
  shaking.on = 0.05;
  scene.forces.push_back(shaking);
  scene.run.end = 0.5;
  const Trajectory t = test::sound_event(scene);
  const auto count = [](const Trajectory& run, EventKind kind, double from) {
    return std::count_if(run.events.begin(), run.events.end(),
                         [&](const Event& e) { return e.kind == kind && e.t > from; });
  };
  // 16 periods of shaking: some sticks in each, not thousands.
  const auto sticks = count(t, EventKind::kStick, 0.05);
  EXPECT_GT(sticks, 8);
  EXPECT_LT(sticks, 100);
  const Trajectory p = test::sound_verlet(scene);
  EXPECT_NEAR(static_cast<double>(count(p, EventKind::kStick, 0.05)), static_cast<double>(sticks),
              0.3 * static_cast<double>(sticks) + 4.0);
  // While it slips, the sign does not alternate from row to row.
  int flips = 0, slips = 0;
  for (std::size_t k = 1; k < p.rows(); ++k) {
    if (p.column("mode")[k] != 1.0 || p.column("mode")[k - 1] != 1.0) continue;
    ++slips;
    flips += p.column("slip")[k] * p.column("slip")[k - 1] < 0.0 ? 1 : 0;
  }
  EXPECT_GT(slips, 20);
  EXPECT_LT(flips, slips / 4);
}

// Free flight, forward rub and backward whip coexist. Each start reaches its own attractor,
// whatever the step.
TEST(HardAttractors, TheSameFromTheSameStart) {
  const Jeffcott j{.mass = 2.0,
                   .damping = 150.0,
                   .stiffness = 2e5,
                   .radius = 0.02,
                   .friction = 0.15,
                   .restitution = 0.2,
                   .speed = 250.0};
  const double load = 70.0, frequency = 420.0;
  const auto rub = oracle::annular_rub({j.mass, j.damping, j.stiffness}, j.clearance, j.friction,
                                       load, frequency);
  ASSERT_TRUE(rub);
  const std::complex<double> free_orbit =
      load /
      std::complex<double>(j.stiffness - j.mass * frequency * frequency, j.damping * frequency);
  ASSERT_LT(std::abs(free_orbit), j.clearance);
  const auto whirl = [&](const Trajectory& t) {
    const std::size_t k = t.rows() - 1;
    const double x = t.column("rotor_x")[k], y = t.column("rotor_y")[k];
    return (x * t.column("rotor_vy")[k] - y * t.column("rotor_vx")[k]) / (x * x + y * y);
  };
  scene::Scene scene = make_scene(j);
  test::add_rotating_force(scene, load, frequency);
  scene.run.end = 0.4;
  // On the rub, on the free orbit (where there is one), and in backward whip.
  for (const double start : {frequency, 0.0, -3000.0}) {
    SCOPED_TRACE(start);
    scene::Scene from = scene;
    if (start >= 0.0) {
      const std::complex<double> z = start > 0.0 ? rub->rotor : free_orbit;
      const std::complex<double> v = std::complex<double>(0.0, frequency) * z;
      from.initial.x = {z.real()};
      from.initial.y = {z.imag()};
      from.initial.vx = {v.real()};
      from.initial.vy = {v.imag()};
    } else {
      from.initial.x = {j.clearance};
      from.initial.vy = {start * j.clearance};
    }
    const Trajectory reference = test::sound_event(from);
    const double speed = whirl(reference);
    EXPECT_EQ(reference.contact_fraction(), start == 0.0 ? 0.0 : 1.0);
    for (const double step : {1e-5, 3e-6, 1e-6}) {
      const Trajectory t = test::run_verlet(from, step);
      test::expect_sound_verlet(from, t, step, fastest(t));
      EXPECT_NEAR(whirl(t), speed, 0.02 * std::abs(speed)) << step;
      EXPECT_EQ(t.column("normal_force").back() > 0.0,
                reference.column("normal_force").back() > 0.0);
    }
  }
}

// ---------------------------------------------------------------- whip
// Backward whip on an elastic ring in whole runs: where it settles, and on which side of a
// watershed a start is.

TEST(HardWhip, TheShippedStartIsTheWhirlAt450) {
  const scene::Scene scene = test::shipped("bench_whip");
  const ElasticWhip whip = test::whip_of(scene);
  const Model model = prepare(scene), exact = prepare(test::whirling(scene, 450.0));
  EXPECT_LT((model.q0 - exact.q0).norm(), 1e-15 * model.q0.norm());
  EXPECT_LT((model.v0 - exact.v0).norm(), 1e-15 * model.v0.norm());
  EXPECT_TRUE(whip.rolls(450.0, scene.first().contact->friction.coefficient));
}

TEST(HardWhip, EventReachesTheWhip) {
  const scene::Scene scene = test::shipped("bench_whip");
  const Trajectory t = test::sound_event(scene);
  EXPECT_EQ(t.statistics.contact_time, scene.run.end) << "never lifts off";
  EXPECT_NEAR(test::whirl_speed(t, t.rows() - 1), -501.9257, 1e-6 * 502.0);
  EXPECT_NEAR(t.column("normal_force").back(), 244.8444, 1e-6 * 245.0);
  const ElasticWhip whip = test::whip_of(scene);
  const double nu = whip.slipping_whips(scene.first().contact->friction.coefficient)[1];
  EXPECT_NEAR(test::whirl_speed(t, t.rows() - 1), -nu, 1e-8 * nu);
  EXPECT_NEAR(t.column("normal_force").back(), whip.normal_force(nu), 1e-7 * 245.0);
}

// Passes are counted from states, not from rows: one row a second gives as many.
TEST(HardWhip, PassesAreTheTurnsOfTheWhirl) {
  scene::Scene scene = test::shipped("bench_whip");
  const Trajectory fine = test::sound_event(scene);
  double angle = 0.0;  // of the rows, 1000 a second
  for (std::size_t k = 1; k < fine.rows(); ++k) {
    angle += 0.5e-3 * (test::whirl_speed(fine, k - 1) + test::whirl_speed(fine, k));
  }
  const int turns = static_cast<int>(-angle / (2.0 * std::numbers::pi));
  scene.run.output_step = 1.0;
  for (const scene::Integrator integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const FullPasses passes = test::run_with(scene, integrator, 1e-4).statistics.passes;
    EXPECT_EQ(passes.backward(), turns);
    EXPECT_EQ(passes.forward(), 0);
    EXPECT_NEAR(passes.time(), 1.0, 0.02);
  }
}

// ---------------------------------------------------------------- the watershed
// On the softer ring there is no stable whip: below the edge the rotor lifts off, above it friction
// speeds the whirl up until it rolls, nu delta_0 = r Omega.
scene::Scene on_soft_ring(double nu) {
  scene::Scene scene = test::shipped("bench_whip");
  scene.first().stator->stiffness.setConstant(1e5);
  scene.first().contact->friction = 0.15;
  return test::whirling(scene, nu);
}

TEST(HardWhip, BelowTheEdgeItLiftsOff) {
  const scene::Scene scene = on_soft_ring(1018.0);
  EXPECT_NEAR(test::whip_of(scene).slipping_whips(0.15).back(), 1019.199, 5e-4);
  const Trajectory t = test::run_event(scene);
  bool lifted = false;
  for (const Event& e : t.events) lifted = lifted || e.kind == EventKind::kLiftOff;
  EXPECT_TRUE(lifted);
  EXPECT_LT(t.contact_fraction(), 0.5);
}

TEST(HardWhip, AboveTheEdgeItComesToRoll) {
  const scene::Scene scene = on_soft_ring(1020.5);
  const Trajectory t = test::sound_event(scene);
  const double rolling =
      scene.first().contact->radius * scene.rotor.speed / scene.first().contact->clearance;
  EXPECT_NEAR(rolling, 31415.927, 5e-4);
  EXPECT_EQ(static_cast<Mode>(t.column("mode").back()), Mode::kStick);
  EXPECT_NEAR(test::whirl_speed(t, t.rows() - 1), -rolling, 1e-9 * rolling);
  EXPECT_NEAR(t.column("normal_force").back(), test::whip_of(scene).normal_force(rolling),
              1e-6 * t.column("normal_force").back());
}

}  // namespace
}  // namespace rotorub
