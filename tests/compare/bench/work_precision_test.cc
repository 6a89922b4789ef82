#include "compare/bench/work_precision.h"

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

// Errors that consist of round-off or of the reference's own error do not affect the order.
TEST(Series, OrderLeavesOutWhatLiesAtTheFloor) {
  std::vector<Point> points;
  for (const double h : {1e-4, 1e-5, 1e-6, 1e-7}) {
    points.push_back(made_point("native-verlet", h, std::max(70.0 * h * h, 3e-11), 1e-3));
  }
  EXPECT_NEAR(*series_of(points, {5e-11, 1.0})[0].order, 2.0, 1e-9);
  EXPECT_LT(*series_of(points, {0.0, 1.0})[0].order, 1.9);
}

// Errors as large as the clearance do not either, because a rotor that has left has no order.
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

using test::made_engine;

constexpr double kClearance = 1e-3;  // m: the levels are 1e-5, 1e-6, ... m

std::vector<BenchEngine> engines() {
  return {made_engine("native-verlet", Family::kNative),
          made_engine("mujoco-rigid", Family::kMujoco), made_engine("mujoco-cone", Family::kMujoco),
          made_engine("ode", Family::kPeer)};
}

// Each engine is represented by the fastest of its points that is accurate enough.
TEST(Levels, TakeTheFastestPointWithinTheLevel) {
  const std::vector<Point> points{
      made_point("native-verlet", 1e-4, 5e-6, 1e-3), made_point("native-verlet", 1e-5, 5e-8, 8e-3),
      made_point("mujoco-rigid", 1e-4, 5e-6, 4e-3),  made_point("mujoco-rigid", 1e-5, 5e-8, 4e-2),
      made_point("mujoco-cone", 1e-4, 8e-6, 3e-3),   made_point("ode", 1e-5, 9e-7, 2e-3)};
  const auto all = levels(points, engines(), kClearance, 0.0);
  ASSERT_EQ(all.size(), 7u);

  ASSERT_EQ(all[0].engines.size(), 4u);
  EXPECT_EQ(all[0].share, 1e-2);
  EXPECT_EQ(all[0].engines[0].engine, "native-verlet");
  EXPECT_EQ(all[0].engines[0].point, 0u);
  EXPECT_EQ(all[0].engines[1].engine, "ode");
  EXPECT_TRUE(*native_is_fastest(all[0]));
  EXPECT_FALSE(*rigid_is_fastest_mujoco(all[0])) << "the cone is quicker at this level";

  // At 1e-6 m ODE is faster than the one native step that is accurate enough.
  ASSERT_EQ(all[1].engines.size(), 3u);
  EXPECT_EQ(all[1].engines[0].engine, "ode");
  EXPECT_FALSE(*native_is_fastest(all[1]));
  EXPECT_TRUE(*rigid_is_fastest_mujoco(all[1])) << "alone among MuJoCo's";

  EXPECT_TRUE(all[4].engines.empty());
  EXPECT_FALSE(native_is_fastest(all[4])) << "nothing to say";
  EXPECT_FALSE(rigid_is_fastest_mujoco(all[4]));
  const std::string verdict = verdict_text(all);
  EXPECT_NE(verdict.find("A native integrator is the fastest, except at 1e-03."), std::string::npos)
      << verdict;
  EXPECT_NE(verdict.find("`rigid` is the fastest, except at 1e-02."), std::string::npos) << verdict;
}

// A level finer than 1e-5 of the clearance is listed but is not the headline.
TEST(Levels, TheHeadlineStopsAtEngineering) {
  const std::vector<Point> points{made_point("native-verlet", 1e-6, 9e-12, 5e-2),
                                  made_point("ode", 1e-5, 9e-10, 2e-3),
                                  made_point("native-verlet", 1e-4, 9e-9, 1e-3)};
  const auto all = levels(points, engines(), kClearance, 0.0);
  EXPECT_TRUE(in_headline(all[3])) << "1e-5";
  EXPECT_FALSE(in_headline(all[4])) << "1e-6";
  EXPECT_FALSE(*native_is_fastest(all[4]));
  const std::string verdict = verdict_text(all);
  EXPECT_NE(verdict.find("the fastest at every level that any engine reaches"), std::string::npos)
      << verdict;
}

// No engine is the fastest without a point.
TEST(Levels, AVerdictOnNothingSaysSo) {
  EXPECT_EQ(verdict_text(levels({}, engines(), kClearance, 0.0)),
            "No engine reaches any of these levels.");
  const std::vector<Point> native{made_point("native-verlet", 1e-4, 5e-6, 1e-3)};
  EXPECT_EQ(verdict_text(levels(native, engines(), kClearance, 0.0)),
            "A native integrator is the fastest at every level that any engine reaches. No setting "
            "of MuJoCo reaches any of these levels.");
}

TEST(Levels, FailuresAndUntimedPointsDoNotCount) {
  Point untimed = made_point("ode", 1e-5, 1e-9, 1e-3);
  untimed.wall = {};
  const std::vector<Point> points{
      untimed, failed_point("mujoco-cone", 1e-4, Outcome::kDiverged, "it flew away")};
  for (const Level& level : levels(points, engines(), kClearance, 0.0)) {
    EXPECT_TRUE(level.engines.empty());
  }
}

// An error that is smaller than the error of the reference has no meaning.
TEST(Levels, KnowWhatTheReferenceCannotTell) {
  const auto all = levels({}, engines(), kClearance, 2e-12);
  EXPECT_TRUE(all[4].judged) << "1e-9 m against 100 times 2e-12";
  EXPECT_FALSE(all[5].judged) << "1e-10 m";
}

}  // namespace
}  // namespace rotorub::bench
