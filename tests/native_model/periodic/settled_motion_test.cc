// The periodic motion to which a run settles.
#include "native_model/periodic/settled_motion.h"

#include <gtest/gtest.h>

#include <string>

#include "native_model/periodic/return_map.h"
#include "native_model/prepare/prepare.h"
#include "tests/native_model/periodic/bounce_once_a_turn.h"
#include "tests/support/native_run.h"

namespace rotorub::periodic {
namespace {

SettledMotion settled(const scene::Scene& scene, SettlingParameters parameters = {}) {
  const Model model = prepare(scene);
  parameters.duration = scene.run.end;
  const SettledMotion found = settled_motion(model, initial_state(model), parameters);
  if (found.found()) {
    const PeriodicMotion& m = found.motion;
    EXPECT_TRUE(m.stable);
    EXPECT_LT(ReturnMap(model).at(m.start, 3.0 * m.period, 3 * m.turns).residual, 1e-8);
    EXPECT_GE(found.run_time, scene.run.end);
  }
  return found;
}

bool says(const SettledMotion& none, const std::string& words) {
  return none.refusal.find(words) != std::string::npos;
}

// The run first comes back closely after three periods, but it settles to a motion of one.
TEST(SettledMotion, HasTheShortestPeriod) {
  const SettledMotion found = settled(test::shipped("compliant_ring"));
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.order, 1);
  EXPECT_NEAR(found.motion.period, 0.02, 1e-12);
}

TEST(SettledMotion, IsSubHarmonicBeyondAPeriodDoubling) {
  test::BounceOnceATurn bounce;
  bounce.swing = 1.05 * bounce.doubling_swing();
  scene::Scene scene = bounce.scene();
  scene.rotor.modal->damping = {0.5};
  const SettledMotion found = settled(scene);
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.order, 2);
  EXPECT_NEAR(found.motion.period, 2.0 * bounce.period(), 1e-12);
  SettlingParameters once;
  once.most_periods = 1;
  const SettledMotion none = settled(scene, once);
  EXPECT_FALSE(none.found()) << "the bounce once a turn is unstable";
  EXPECT_TRUE(says(none, "after at most 1 period")) << none.refusal;
}

TEST(SettledMotion, OfAFreePeriodHasNoOrder) {
  const SettledMotion found = settled(test::shipped("bench_whip"));
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.order, 0);
}

TEST(SettledMotion, IsNoneIfTheRunComesToRest) {
  const SettledMotion none = settled(test::shipped("bench_drop"));
  EXPECT_EQ(none.refusal, "the run comes to rest");
  const SettledMotion decays =
      settled(test::shipped("bench_whip", {"contact.friction=0.0", "run.end=0.2"}));
  EXPECT_EQ(decays.refusal, "the run comes to rest");
}

TEST(SettledMotion, EndsAtItsLimitOfEffort) {
  SettlingParameters little;
  little.most_stretches = 3000;
  const SettledMotion none = settled(test::shipped("two_catchers"), little);
  EXPECT_TRUE(says(none, "limit of effort")) << none.refusal;
}

TEST(SettledMotion, RefusesWhatDoesNotRepeat) {
  EXPECT_TRUE(says(settled(test::shipped("earthquake")), "motion of the base"));
}

}  // namespace
}  // namespace rotorub::periodic
