// Backward whip on an elastic ring by whole runs: where it settles, and on which side of a
// watershed a start lies.
#include <gtest/gtest.h>

#include <numbers>

#include "native_model/prepare/prepare.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/elastic_whip.h"
#include "tests/support/whip.h"

namespace rotorub {
namespace {

using oracle::ElasticWhip;

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

// Passes are counted by states, not by rows: one row a second sees as many.
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
  ASSERT_EQ(t.status, Status::kOk) << t.message;
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
