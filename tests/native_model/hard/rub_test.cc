// Hard cases by whole runs: backward whip and its watershed, contacts that jam, runs that end
// early, and the order of euler. The further hard cases are the scenes of mjcf/hard with their
// rules, which the test CliCheckLong.TheHardCasesHold runs.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "native_model/scene/reader.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/elastic_whip.h"
#include "tests/support/order.h"
#include "tests/support/whip.h"

namespace rotorub {
namespace {

using oracle::ElasticWhip;
using test::Jeffcott;
using test::make_scene;
using test::rotor_error;
using test::run_with;
using test::shipped;

// ---------------------------------------------------------------- whip
// Backward whip on an elastic ring in whole runs: where it settles, and on which side of a
// watershed a start is.

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
  EXPECT_EQ(static_cast<ContactMode>(t.column("mode").back()), ContactMode::kStick);
  EXPECT_NEAR(test::whirl_speed(t, t.rows() - 1), -rolling, 1e-9 * rolling);
  EXPECT_NEAR(t.column("normal_force").back(), test::whip_of(scene).normal_force(rolling),
              1e-6 * t.column("normal_force").back());
}

// ---------------------------------------------------------------- a contact that jams
// Masses that differ between x and y couple N and T. Under mu > (a_x + a_y) / |a_x - a_y| sliding
// one way has no force, or more than one: `event` says so. On impulses there always is a solution
// (the slip is stopped at once), and `verlet` takes it. Never NaN.
TEST(HardPainleve, SaidOnForcesSolvedOnImpulses) {
  int said = 0, solved = 0;
  for (const double mu : {0.5, 1.1, 1.5, 3.0, 10.0}) {
    for (const double speed : {-200.0, 200.0}) {
      for (const double push : {-40.0, 0.0, 40.0}) {
        SCOPED_TRACE(testing::Message() << mu << ' ' << speed << ' ' << push);
        scene::Scene scene = make_scene({.mass = 2.0,
                                         .damping = 1.0,
                                         .stiffness = 1e4,
                                         .friction = mu,
                                         .restitution = 0.0,
                                         .speed = speed});
        scene.rotor.modal->mass_y = {0.2};
        scene.rotor.modal->stiffness_y = {1e4};
        scene.rotor.modal->damping_y = {1.0};
        const double h = 0.5e-3 * std::sqrt(0.5);
        scene.initial.x = scene.initial.y = {h};  // at 45 degrees, where G_NT is largest
        test::add_constant_force(scene, {push, push});
        scene.run.end = 0.02;
        const bool can_jam = mu > (1.0 / 0.2 + 1.0 / 2.0) / (1.0 / 0.2 - 1.0 / 2.0);
        const Trajectory t = test::attempt_event(scene), p = test::run_verlet(scene, 1e-5);
        for (const Trajectory* run : {&t, &p}) {
          test::expect_refused_or_finite(*run);
          test::expect_dissipative_impacts(scene, *run);
          if (run->status == Status::kOk) continue;
          EXPECT_TRUE(can_jam);
          EXPECT_TRUE(run->status == Status::kNoSolution || run->status == Status::kAmbiguous);
          EXPECT_NE(run->message.find("Painleve"), std::string::npos) << run->message;
          EXPECT_LT(run->end, scene.run.end);
        }
        if (t.status == Status::kOk) test::expect_sound_event(scene, t);
        said += t.status == Status::kOk ? 0 : 1;
        solved += t.status == Status::kOk ? 1 : 0;
      }
    }
  }
  EXPECT_GT(said, 0);
  EXPECT_GT(solved, 10);
}

// ---------------------------------------------------------------- ends of runs
// A balance of the energy that does not close tells of the order of a scheme, and is no reason
// either: a motor that holds the speed within a step, a row within an impact, a rotor that is at
// rest.
TEST(HardExploded, ABalanceThatDoesNotCloseEndsNoRun) {
  const scene::Scene stiff =
      shipped("bench_ring", {"drive.gain=10.0", "rotor.modal.inertia=1e-5", "run.end=0.1"});
  EXPECT_LT(rotor_error(test::run_event(stiff), run_with(stiff, scene::Integrator::kVerlet, 1e-5)),
            1e-8);

  const scene::Scene rows = shipped(
      "bench_ring", {"contact.compression_time=1e-3", "contact.expansion_time=5e-4", "drive=none",
                     "rotor.speed=0.0", "run.end=20ms", "run.output_step=20us"});
  run_with(rows, scene::Integrator::kVerlet, 1e-5);

  const scene::Scene resting = shipped("bench_drop", {"initial.y=[-0.0005]"});
  for (const scene::Integrator integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = run_with(resting, integrator);
    // Relative to the weight times the clearance.
    EXPECT_LT(t.statistics.energy_residual(), 1e-5);
  }
}

// A rotor that nothing holds or stops leaves its machine, and the run reports it.
TEST(HardExploded, ARotorThatNothingHoldsLeaves) {
  const scene::Scene scene = scene::parse_scene(
      "[run]\nend = 3.0\nstep = 1e-3\n[rotor]\nspeed = 0.0\n[rotor.modal]\nmass = [2.0]\n"
      "stiffness = [0.0]\ndamping = [0.0]\n[[force]]\nkind = \"constant\"\n"
      "vector = [1e6, 0.0]\n",
      "gone.toml", {});
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = test::attempt_with(scene, integrator, 1e-3);
    EXPECT_EQ(t.status, Status::kOutOfRange) << static_cast<int>(integrator);
    EXPECT_NE(t.message.find("the rotor has left"), std::string::npos) << t.message;
    EXPECT_NEAR(t.end, std::sqrt(2.0 * 1e3 / 5e5), 2e-3);
  }
}

// ---------------------------------------------------------------- order of euler
// It tends to `event` at first order: a tenth of the step, a tenth of the error.

double distance(const Trajectory& a, const Trajectory& b) {
  double most = 0.0;
  for (const char* column : {"rotor_x", "rotor_y", "stator_x", "stator_y"}) {
    for (std::size_t k = 0; k < a.rows(); ++k) {
      most = std::max(most, std::abs(a.column(column)[k] - b.column(column)[k]));
    }
  }
  return most;
}

// Over two decades of steps. Impacts fall at random within their steps, so that single ratios
// scatter around 10; over both decades a first-order scheme gains a factor of 100.
void expect_first_order(const scene::Scene& scene) {
  SCOPED_TRACE(scene.name);
  const Trajectory exact = test::sound_event(scene);
  EXPECT_GT(exact.statistics.first_touch, 0.0);
  const auto at = [&](double step) {
    return distance(test::run_with(scene, scene::Integrator::kEuler, step), exact);
  };
  const double coarse = at(2e-5);
  const double middle = at(2e-6);
  const double fine = at(2e-7);
  EXPECT_LT(middle, coarse / 3.0);
  EXPECT_LT(fine, middle / 3.0);
  EXPECT_LT(fine, coarse / 30.0) << coarse << ' ' << middle << ' ' << fine;
  EXPECT_GT(fine, coarse / 3000.0) << "a faithful first-order scheme: " << coarse << ' ' << fine;
}

TEST(HardConvergence, TwoModesWithTorsionAndGyroscopics) {
  scene::Scene scene = test::shipped("bench_ring");
  scene.name = "two_modes";
  scene::RotorModal& m = *scene.rotor.modal;
  m.mass = m.mass_y = {2.0, 0.8};
  m.stiffness = m.stiffness_y = {2e5, 3e6};
  m.damping = m.damping_y = {60.0, 200.0};
  m.internal_damping = {5.0, 5.0};
  m.gyroscopic = {0.05, 0.1};
  scene.rotor.torsion = scene::Torsion{0, 0.0, {4e-4}, {60.0}, {0.02}, {-0.5}};
  scene.first().contact->restitution = 0.2;
  scene.forces[0].shape = {1.0, 0.3};
  scene.forces[0].ramp = 0.01;
  scene.run.end = 0.03;
  expect_first_order(scene);
}

}  // namespace
}  // namespace rotorub
