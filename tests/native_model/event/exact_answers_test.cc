// The event-driven integrator against every exact answer that concerns motion.
#include "native_model/event/driver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "native_model/oracles/bounces.h"
#include "native_model/run/run_native.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/elastic_whip.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;
using test::row_of;
using test::run_event;
using test::shipped;

Eigen::Vector2d rotor(const Trajectory& t, std::size_t row) {
  return {t.column("rotor_x")[row], t.column("rotor_y")[row]};
}

TEST(EventBilliard, EveryRowAndImpactToRoundOff) {
  const Trajectory t = run_event(shipped("bench_billiard"));
  const oracle::Billiard exact(0.5e-3, {1e-4, 0.0}, {0.3, 0.4});
  for (std::size_t k = 0; k < t.rows(); ++k) {
    ASSERT_LT((rotor(t, k) - exact.position(t.column("t")[k])).norm(), 1e-13) << k;
  }
  ASSERT_EQ(t.impacts.size(), 101u);
  for (std::size_t k = 0; k < t.impacts.size(); ++k) {
    const double time = exact.first_impact() + static_cast<double>(k) * exact.chord_time();
    ASSERT_NEAR(t.impacts[k].t, time, 1e-12);
  }
}

TEST(EventDrop, BouncesAndRestToRoundOff) {
  const Trajectory t = run_event(shipped("bench_drop"));
  const oracle::Drop exact{0.5e-3, 9.81, 0.5};
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const double height = exact.height_at(t.column("t")[k]);
    ASSERT_NEAR(t.column("rotor_y")[k], height - 0.5e-3, 1e-13) << t.column("t")[k];
  }
  for (int k = 0; k < 20; ++k) {
    ASSERT_NEAR(t.impacts[static_cast<std::size_t>(k)].t, exact.impact_time(k), 1e-12) << k;
  }
  // The accumulation closes at the rest time, short of it by the flights under 1e-9 m/s.
  ASSERT_EQ(t.events.back().kind, EventKind::kStick);
  EXPECT_NEAR(t.events.back().t, exact.rest_time(), 1e-9 / 9.81 * 2.0);
  EXPECT_NEAR(t.column("normal_force").back(), 19.62, 1e-12);
}

TEST(EventBenchRing, ThePublishedStates) {
  scene::Scene scene = shipped("bench_ring");
  scene.run.output_times = {0.02};
  const Trajectory t = run_event(scene);
  const double digits = 2e-15;  // the published ones are given to 1e-13 relative
  EXPECT_LT(
      (rotor(t, row_of(t, 0.02)) - Eigen::Vector2d(3.200529602935e-4, -1.197270224039e-3)).norm(),
      digits);
  EXPECT_LT((rotor(t, t.rows() - 1) - Eigen::Vector2d(5.15768981628e-4, -2.036936721118e-3)).norm(),
            digits);
  EXPECT_NEAR(t.column("normal_force").back(), 121.7020407, 5e-8);
  const double published[] = {4.0601e-3, 7.5981e-3, 8.9758e-3, 9.5869e-3, 9.8768e-3};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(t.impacts[k].t, published[k], 6e-8);
  EXPECT_NEAR(t.impacts.back().t, 10.158e-3, 1e-6);
  EXPECT_LT(t.statistics.energy_residual(), 1e-12);
}

// Backward whip: the Riccati equation while sliding, then rolling at nu = Omega r / delta_0.
TEST(EventWhip, GrowsByTheRiccatiEquationUntilItRolls) {
  const Jeffcott j{.mass = 2.0,
                   .damping = 5.0,
                   .stiffness = 2e5,
                   .radius = 0.02,
                   .friction = 0.2,
                   .speed = 200.0};
  const oracle::BackwardWhip exact{j.mass, j.damping, j.stiffness, j.friction, j.clearance};
  const double start = 1.3 * exact.growth_threshold();
  const double rolling = j.speed * j.radius / j.clearance;
  scene::Scene scene = make_scene(j);
  scene.initial.x = {j.clearance};
  scene.initial.vy = {-start * j.clearance};
  scene.run.end = exact.blow_up(start);
  const Trajectory t = run_event(scene);
  bool slid = false;
  for (std::size_t k = 1; k < t.rows(); ++k) {
    const double x = t.column("rotor_x")[k], y = t.column("rotor_y")[k];
    const double vx = t.column("rotor_vx")[k], vy = t.column("rotor_vy")[k];
    const double nu = -(x * vy - y * vx) / (j.clearance * j.clearance);
    if (static_cast<ContactMode>(t.column("mode")[k]) == ContactMode::kSlide) {
      slid = true;
      ASSERT_NEAR(nu, exact.whirl_speed(start, t.column("t")[k]), 1e-10 * nu);
      ASSERT_NEAR(t.column("normal_force")[k], exact.normal_force(nu),
                  1e-9 * exact.normal_force(nu));
    } else {
      ASSERT_EQ(static_cast<ContactMode>(t.column("mode")[k]), ContactMode::kStick);
      ASSERT_NEAR(nu, rolling, 1e-10 * rolling);
    }
  }
  EXPECT_TRUE(slid);
  ASSERT_EQ(t.events.back().kind, EventKind::kStick);
}

TEST(EventOutput, RowsDoNotDisturbTheSteps) {
  scene::Scene few = shipped("bench_ring"), many = few;
  few.run.output_step = 0.1;
  many.run.output_step = 1e-4;
  many.run.output_times = {0.0123456789, 0.3333333333};
  const Trajectory a = run_event(few), b = run_event(many);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(rotor(a, a.rows() - 1), rotor(b, b.rows() - 1)) << "to the bit";
  EXPECT_EQ(b.column("t")[row_of(b, 0.0123456789)], 0.0123456789);
}

TEST(EventDeterminism, SameSceneSameBits) {
  scene::Scene rig = shipped("paper_passive");
  rig.rotor.geometry->modes = 2;
  const Trajectory a = run_event(rig), b = run_event(rig);
  ASSERT_EQ(a.impacts.size(), b.impacts.size());
  for (const Column& column : a.series) EXPECT_EQ(column.values, b.column(column.name));
}

}  // namespace
}  // namespace rotorub
