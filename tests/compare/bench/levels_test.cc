#include "compare/bench/levels.h"

#include <gtest/gtest.h>

#include "tests/compare/bench/made_points.h"

namespace rotorub::bench {
namespace {

using test::failed_point;
using test::made_engine;
using test::made_point;

constexpr double kClearance = 1e-3;  // m: the levels are 1e-5, 1e-6, ... m

std::vector<BenchEngine> engines() {
  return {made_engine("native-verlet", Family::kNative),
          made_engine("mujoco-rigid", Family::kMujoco), made_engine("mujoco-cone", Family::kMujoco),
          made_engine("ode", Family::kPeer)};
}

// Each engine counts with the quickest of its points that is exact enough.
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

  // 1e-6 m: ODE is quicker than the one native step that is exact enough.
  ASSERT_EQ(all[1].engines.size(), 3u);
  EXPECT_EQ(all[1].engines[0].engine, "ode");
  EXPECT_FALSE(*native_is_fastest(all[1]));
  EXPECT_TRUE(*rigid_is_fastest_mujoco(all[1])) << "alone among MuJoCo's";

  EXPECT_TRUE(all[4].engines.empty());
  EXPECT_FALSE(native_is_fastest(all[4])) << "nothing to say";
  EXPECT_FALSE(rigid_is_fastest_mujoco(all[4]));
  const std::string verdict = verdict_text(all);
  EXPECT_NE(verdict.find("but not at 1e-03;"), std::string::npos) << verdict;
  EXPECT_NE(verdict.find("settings but not at 1e-02"), std::string::npos) << verdict;
}

// What is finer than 1e-5 of the clearance is listed, and is no headline.
TEST(Levels, TheHeadlineStopsAtEngineering) {
  const std::vector<Point> points{made_point("native-verlet", 1e-6, 9e-12, 5e-2),
                                  made_point("ode", 1e-5, 9e-10, 2e-3),
                                  made_point("native-verlet", 1e-4, 9e-9, 1e-3)};
  const auto all = levels(points, engines(), kClearance, 0.0);
  EXPECT_TRUE(in_headline(all[3])) << "1e-5";
  EXPECT_FALSE(in_headline(all[4])) << "1e-6";
  EXPECT_FALSE(*native_is_fastest(all[4]));
  const std::string verdict = verdict_text(all);
  EXPECT_NE(verdict.find("fastest at every level reached"), std::string::npos) << verdict;
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

// An error that is nearer to the reference than the reference to the truth says nothing.
TEST(Levels, KnowWhatTheReferenceCannotTell) {
  const auto all = levels({}, engines(), kClearance, 2e-12);
  EXPECT_TRUE(all[4].judged) << "1e-9 m against 100 times 2e-12";
  EXPECT_FALSE(all[5].judged) << "1e-10 m";
}

}  // namespace
}  // namespace rotorub::bench
