#include "compare/bench/series.h"

#include <gtest/gtest.h>

#include "tests/compare/bench/made_points.h"

namespace rotorub::bench {
namespace {

using test::failed_point;
using test::made_point;

TEST(FittedOrder, FindsTheSlope) {
  const std::vector<double> steps{1e-4, 5e-5, 1e-5, 1e-6};
  std::vector<double> second, first;
  for (const double h : steps) {
    second.push_back(70.0 * h * h);
    first.push_back(0.1 * h);
  }
  EXPECT_NEAR(*fitted_order(steps, second), 2.0, 1e-12);
  EXPECT_NEAR(*fitted_order(steps, first), 1.0, 1e-12);
  EXPECT_FALSE(fitted_order({1e-4, 1e-5}, {1e-6, 1e-8})) << "two points are no trend";
  EXPECT_FALSE(fitted_order({1e-4, 1e-4, 1e-4}, {1e-6, 1e-8, 1e-7})) << "one step is no ladder";
}

TEST(Series, GatherWhatDiffersInStepOrToleranceAlone) {
  const std::vector<Point> points{
      made_point("native-event", {}, 1e-8, 1e-3, "tolerance 1e-06"),
      made_point("native-event", {}, 1e-10, 2e-3, "tolerance 1e-08"),
      made_point("mujoco-cone", 1e-4, 1e-4, 1e-3, "Euler"),
      made_point("mujoco-cone", 1e-4, 2e-4, 1e-3, "implicit"),
      failed_point("mujoco-cone", 1e-5, Outcome::kDiverged, "it flew away")};
  const auto all = series_of(points, {0.0, 1.0});
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].points.size(), 2u);
  EXPECT_EQ(all[0].setting, "");
  EXPECT_EQ(*all[0].best, 1u);
  EXPECT_EQ(all[1].setting, "Euler");
  EXPECT_EQ(all[2].setting, "implicit");
  EXPECT_FALSE(all[3].best);
  EXPECT_EQ(all[3].reason, "it flew away");
  EXPECT_EQ(outcomes_text(all[3]), "1 diverged");
  EXPECT_EQ(all[3].us_per_step, 0.0) << "never timed";
}

// What round-off or the reference itself made of an error does not spoil the order.
TEST(Series, OrderLeavesOutWhatLiesAtTheFloor) {
  std::vector<Point> points;
  for (const double h : {1e-4, 1e-5, 1e-6, 1e-7}) {
    points.push_back(made_point("native-verlet", h, std::max(70.0 * h * h, 3e-11), 1e-3));
  }
  EXPECT_NEAR(*series_of(points, {5e-11, 1.0})[0].order, 2.0, 1e-9);
  EXPECT_LT(*series_of(points, {0.0, 1.0})[0].order, 1.9);
}

// Nor do errors as large as the clearance: what has flown away has no order.
TEST(Series, OrderLeavesOutWhatIsNoResult) {
  std::vector<Point> points{made_point("ode", 1e-3, 4e3, 1e-3)};
  for (const double h : {1e-4, 1e-5, 1e-6}) points.push_back(made_point("ode", h, 0.5 * h, 1e-3));
  EXPECT_NEAR(*series_of(points, {0.0, 5e-4})[0].order, 1.0, 1e-9);
}

TEST(SettingText, NamesStepOrTolerance) {
  EXPECT_EQ(setting_text(made_point("ode", 1e-5, 0.0, 0.0).setting), "10 µs");
  EXPECT_EQ(setting_text(made_point("mujoco-cone", 1e-5, 0.0, 0.0, "implicit").setting),
            "implicit, 10 µs");
  EXPECT_EQ(setting_text(made_point("native-event", {}, 0.0, 0.0, "tolerance 1e-08").setting),
            "tolerance 1e-08");
}

}  // namespace
}  // namespace rotorub::bench
