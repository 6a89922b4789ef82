// How many runs a comparison makes, and how long they are.
#include "compare/study/comparison_runs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/figures/figure.h"
#include "tests/compare/hand_made.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

constexpr double kEnd = 0.8;  // s

scene::Run run_of(double step) {
  scene::Run run;
  run.end = kEnd;
  run.step = step;
  return run;
}

// Presses on the ring from `from` (s) until `to`.
Side pressing(double from, double to) {
  Side side;
  side.trajectory = test::hand_made(801, 1e-3, [&](double t) {
    test::Row row;
    row.normal = t >= from && t < to ? 10.0 : 0.0;
    return row;
  });
  return side;
}

double end_with(double step, const std::vector<Side>& sides) {
  std::vector<const Side*> all;
  for (const Side& side : sides) all.push_back(&side);
  return timed_end(run_of(step), all);
}

TEST(TimedEnd, IsAnEighthWhereContactIsAsFrequentThere) {
  EXPECT_DOUBLE_EQ(end_with(1e-6, {pressing(0.0, kEnd), pressing(2e-3, kEnd)}), 0.1);
}

// In contact for half of the run: up to 0.6 s for a third of the time, up to 0.7 s for 43 %. Or for
// a twentieth of it, early: up to 0.2 s for a fifth, up to 0.3 s for 13 %.
TEST(TimedEnd, TakesInWhatIsUnlikeTheStart) {
  EXPECT_DOUBLE_EQ(end_with(1e-6, {pressing(0.4, kEnd)}), 0.7);
  EXPECT_DOUBLE_EQ(end_with(1e-6, {pressing(0.05, 0.09), pressing(0.02, 0.06)}), 0.3);
}

TEST(TimedEnd, HasTenThousandStepsOrAll) {
  EXPECT_DOUBLE_EQ(end_with(2.5e-5, {pressing(0.0, kEnd)}), 0.3);
  EXPECT_DOUBLE_EQ(end_with(1e-3, {pressing(0.0, kEnd)}), kEnd);
}

// A figure by itself, of sides at a step and at half of it, beside a native value of 100 N.
struct Climbed {
  Metrics native;
  Side side;
  StepLevel half{{}, ""};
  StepTest test;
  Climbed(double whole, double at_half, double scatter)
      : native(metrics_of(100.0)), test{native, 0.01, std::vector(figures().size(), scatter)} {
    side.metrics = metrics_of(whole);
    half.metrics = metrics_of(at_half);
  }
  static Metrics metrics_of(double force) {
    Metrics m;
    m.mean_force = force;
    return m;
  }
  bool needs() const { return needs_quarter(side, half, test); }
  // The extrapolated mean force.
  Extrapolation limit(double quarter = 0.0) {
    Ladder ladder;
    ladder[1] = half;
    ladder[2] = {metrics_of(quarter), needs() ? "" : "not run"};
    side.limits.clear();
    set_limits(ladder, test, side);
    for (std::size_t k = 0; k < figures().size(); ++k) {
      if (std::string_view(figures()[k].key) == "mean_force") return side.limits[k];
    }
    return {};
  }
};

TEST(Ladder, EndsAtHalfTheStepWhereThatChangesNextToNothing) {
  Climbed climbed(100.5, 100.46, 0.0);  // 0.04 % of native, where 5 % of the tolerance are 0.05 %
  EXPECT_FALSE(climbed.needs());
  const Extrapolation limit = climbed.limit();
  EXPECT_TRUE(limit.valid) << limit.reason;
  EXPECT_EQ(limit.limit, 100.46);
  EXPECT_NEAR(limit.uncertainty, 0.04, 1e-12);
  EXPECT_TRUE(std::isnan(limit.values[2]));
}

TEST(Ladder, EndsThereBesideALargeDifference) {
  EXPECT_FALSE(Climbed(150.0, 152.0, 0.0).needs()) << "2 % of change beside 50 % of difference";
  EXPECT_TRUE(Climbed(150.0, 153.0, 0.0).needs());
}

TEST(Ladder, GoesOnToAQuarterWhereTheStepMatters) {
  Climbed climbed(104.0, 102.0, 0.0);
  EXPECT_TRUE(climbed.needs());
  const Extrapolation limit = climbed.limit(101.0);
  EXPECT_TRUE(limit.valid) << limit.reason;
  EXPECT_NEAR(limit.limit, 100.0, 1e-9);
  EXPECT_NEAR(limit.order, 1.0, 1e-9);
}

TEST(Ladder, HasNoLimitWithinTheScatter) {
  Climbed climbed(104.0, 102.0, 0.03);
  EXPECT_FALSE(climbed.needs());
  const Extrapolation limit = climbed.limit();
  EXPECT_FALSE(limit.valid);
  EXPECT_NE(limit.reason.find("scatters"), std::string::npos) << limit.reason;
}

}  // namespace
}  // namespace rotorub
