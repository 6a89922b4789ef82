#include "compare/metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/compare/hand_made.h"

namespace rotorub {
namespace {

using test::hand_made;
using test::sliding;
using test::Whirl;

const Whirl kWhirl;
const ContactFacts kFacts{kWhirl.clearance, kWhirl.radius, kWhirl.friction};

// Half a second in contact from t = 0.5 s of 1 s, with 100 N on for half of that time.
Trajectory half_touched() {
  Trajectory t = hand_made(1001, 1e-3, [](double time) { return sliding(kWhirl, time); });
  Statistics& s = t.statistics;
  s.first_touch = 0.5;
  s.contact_time = 0.25;
  s.impulse_total = 25.0;
  s.force_square = 100.0 * 100.0 * 0.25;
  s.peak_force = 130.0;
  s.friction_impulse = -5.0;
  s.friction_work = -3.0;
  s.max_penetration = 2e-6;
  s.penetration_square = 0.5 * 1e-12;
  s.gap_rate_square = 0.5 * 4e-6;
  // 3 J gained; the loads do work of 4 J, the contact takes 2 J; the largest energy is 4 J.
  s.energy_start = 1.0, s.energy_end = 4.0, s.energy_scale = 4.0;
  s.external_work = 4.0, s.contact_work = -2.0;
  t.steps = 1000;
  t.wall_s = 0.002;
  return t;
}

TEST(Metrics, AreTakenFromFirstTouch) {
  const Metrics m = metrics(half_touched(), {kFacts});
  ASSERT_TRUE(m.first_touch);
  EXPECT_DOUBLE_EQ(*m.first_touch, 0.5);
  EXPECT_DOUBLE_EQ(m.mean_force, 50.0);
  EXPECT_DOUBLE_EQ(m.force_deviation, 50.0);  // half the time 100 N, half 0
  EXPECT_DOUBLE_EQ(m.contact_fraction, 0.5);
  EXPECT_DOUBLE_EQ(m.rms_penetration, 1e-6);
  EXPECT_DOUBLE_EQ(m.gap_rate_rms, 2e-3);
  EXPECT_DOUBLE_EQ(m.peak_force, 130.0);
  EXPECT_DOUBLE_EQ(m.impulse_total, 25.0);
  EXPECT_DOUBLE_EQ(m.friction_impulse, -5.0);
  EXPECT_DOUBLE_EQ(m.friction_work, -3.0);
  EXPECT_DOUBLE_EQ(m.max_penetration, 2e-6);
  EXPECT_DOUBLE_EQ(m.energy_residual, 0.25);
  EXPECT_DOUBLE_EQ(m.us_per_step, 2.0);
  EXPECT_DOUBLE_EQ(m.real_time_factor, 500.0);
}

TEST(DeepestPenetration, IsThatOfTheContactItIsDeepestFor) {
  Statistics s;
  s.contacts[0].max_penetration = 2e-6;
  EXPECT_DOUBLE_EQ(deepest_penetration(s, {kFacts}).share, 2e-6 / kWhirl.clearance);
  ContactFacts narrow = kFacts;
  narrow.clearance = 0.1 * kWhirl.clearance;
  s.contacts.resize(2);
  s.contacts[1].max_penetration = 1e-6;
  const DeepestPenetration deepest = deepest_penetration(s, {kFacts, narrow});
  EXPECT_EQ(deepest.contact, 1U);
  EXPECT_EQ(deepest.depth, 1e-6);
  EXPECT_DOUBLE_EQ(deepest.share, 1e-6 / narrow.clearance);
  std::swap(s.contacts[0], s.contacts[1]);
  const DeepestPenetration other = deepest_penetration(s, {narrow, kFacts});
  EXPECT_EQ(other.contact, 0U);
  EXPECT_EQ(other.share, deepest.share);
}

// A fixed step sees the gap only at its ends, so an impact within it counts as a gap of 0.
TEST(Metrics, TheLeastGapOfATouchIsNone) {
  Trajectory t = half_touched();
  EXPECT_FALSE(metrics(t, {kFacts}).least_gap) << "no [contact] told a gap";
  t.statistics.least_gap = 3e-6;
  EXPECT_EQ(metrics(t, {kFacts}).least_gap, 0.0);
  t.statistics.least_gap = -2e-6;
  EXPECT_EQ(metrics(t, {kFacts}).least_gap, -2e-6);
  t.statistics.first_touch = -1.0;
  t.statistics.least_gap = 3e-6;
  EXPECT_EQ(metrics(t, {kFacts}).least_gap, 3e-6);
}

// A disc that leaves along the tangent at v_t = omega delta_0 is (v_t dt)^2 / (2 delta_0) beyond
// the ring after dt. Flights between the touches, ten times as fast along the ring, have no part in
// it.
// Many more rows in the second in which the force is 10 N do not change the mean.
TEST(Metrics, TheControlForceIsAMeanOverTime) {
  const auto rms = [](const std::vector<double>& times) {
    Trajectory t = hand_made(times.size(), 1e-3, [](double time) { return sliding(kWhirl, time); });
    std::vector<double> force, none(times.size(), 0.0);
    for (const double time : times) force.push_back(time < 1.0 ? 10.0 : 20.0);
    t.series[0].values = times;
    t.series.push_back({"control_x", "N", force});
    t.series.push_back({"control_y", "N", none});
    return metrics(t, {kFacts}).control_force.value();
  };
  std::vector<double> equal, dense;
  for (int k = 0; k < 2000; ++k) equal.push_back(k * 1e-3);
  for (int k = 0; k < 10000; ++k) dense.push_back(k * 1e-4);
  for (int k = 1000; k < 2000; ++k) dense.push_back(k * 1e-3);
  EXPECT_NEAR(rms(equal), std::sqrt(250.0), 1e-12);
  EXPECT_NEAR(rms(dense), std::sqrt(250.0), 1e-2);
}

TEST(Metrics, TheStepsPenetrationIsThatOfTheRowsInContact) {
  const Trajectory t = hand_made(1001, 1e-3, [](double time) {
    test::Row row = sliding(kWhirl, time);
    if (std::fmod(time, 0.1) < 0.05) return row;
    row.normal = row.friction = 0.0;
    row.vx *= 10.0, row.vy *= 10.0;
    return row;
  });
  const double way = kWhirl.frequency * kWhirl.clearance * 1e-3;
  const double due = way * way / (2.0 * kWhirl.clearance);
  EXPECT_NEAR(metrics(t, {kFacts}).whirl_penetration, due, 1e-9 * due);
}

TEST(Metrics, CountImpactsThatClose) {
  Trajectory t = half_touched();
  t.impacts.push_back({0.5, 0.02, 0.0, -0.1, 0.05, 0.0, 0.0, 0.0});
  t.impacts.push_back({0.6, 0.05, 0.0, -0.2, 0.1, 0.0, 0.0, 0.0});
  t.impacts.push_back({0.65, 1e-3, 0.0, -1.9e-3, 1e-3, 0.0, 0.0, 0.0});  // 0.95 % of the fastest
  t.impacts.push_back({0.7, 1e-9, 0.0, -1e-8, 0.0, 0.0, 0.0, 0.0});
  const Metrics m = metrics(t, {kFacts});
  EXPECT_EQ(m.impacts, 3U);
  EXPECT_EQ(m.hard_impacts, 2U);
  EXPECT_DOUBLE_EQ(m.peak_impulse, 0.05);
}

TEST(Metrics, OfARotorThatNeverTouchesAreZero) {
  const Trajectory t = hand_made(100, 1e-3, [](double) {
    test::Row row;
    row.gap = kWhirl.clearance;
    return row;
  });
  const Metrics m = metrics(t, {kFacts});
  EXPECT_FALSE(m.first_touch);
  EXPECT_EQ(m.mean_force, 0.0);
  EXPECT_EQ(m.contact_fraction, 0.0);
  EXPECT_EQ(m.force_deviation, 0.0);
  EXPECT_EQ(m.whirl_penetration, 0.0);
  EXPECT_EQ(m.settled.attractor, Attractor::kNoContact);
  EXPECT_EQ(m.us_per_step, 0.0);
}

}  // namespace
}  // namespace rotorub
