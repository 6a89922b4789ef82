// The texts for the points of a sweep and their time.
#include "compare/commands/sweep_progress.h"

#include <gtest/gtest.h>

namespace rotorub {
namespace {

constexpr sweep::Shard kWhole{};

TEST(SweepPlanText, HasTheTimeOfAllPointsOfThisCall) {
  EXPECT_EQ(plan_text({500, 100, 100, 32.0}, kWhole, 2, 8.2),
            "500 points will take about 40 s with 2 jobs");
  EXPECT_EQ(plan_text({500, 400, 20, 5.0}, kWhole, 1, 1.0),
            "120 of 500 points will take about 6 s with 1 job; the others are done");
  EXPECT_EQ(plan_text({125, 10, 10, 3600.0}, {2, 4}, 3, 0.0),
            "125 points of shard 2/4 will take about 60 min with 3 jobs");
  EXPECT_EQ(plan_text({10000, 10, 10, 7190.0}, kWhole, 2, 10.0),
            "10000 points will take about 2.0 h with 2 jobs");
  EXPECT_EQ(plan_text({1, 1, 1, 0.0}, kWhole, 2, 0.2),
            "1 point will take less than 1 s with 2 jobs");
}

TEST(SweepPlanText, HasNoTimeBeforeAPointIsDone) {
  EXPECT_EQ(plan_text({500, 0, 0, {}}, kWhole, 2, 3.0),
            "500 points will run with 2 jobs; an estimate of the time will follow");
}

TEST(SweepPlanText, SaysThatNothingIsLeft) {
  EXPECT_EQ(plan_text({500, 500, 0, 0.0}, kWhole, 2, 0.0),
            "nothing is left to run; results of 500 points are stored");
  EXPECT_EQ(plan_text({0, 0, 0, 0.0}, {4, 4}, 2, 0.0),
            "nothing is left to run; results of 0 points of shard 4/4 are stored");
}

}  // namespace
}  // namespace rotorub
