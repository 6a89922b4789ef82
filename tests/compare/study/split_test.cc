#include "compare/metrics/extrapolation.h"

#include <gtest/gtest.h>

namespace rotorub {
namespace {

// First order in the step: native 100 + 4 h, other 103 + 8 h, at h = 1.
TEST(Split, TellsModelFromStep) {
  const Split s = split(extrapolate({104.0, 102.0, 101.0}), extrapolate({111.0, 107.0, 105.0}));
  EXPECT_TRUE(s.valid);
  EXPECT_DOUBLE_EQ(s.difference, 7.0);
  EXPECT_NEAR(s.model_gap, 3.0, 1e-12);
  EXPECT_NEAR(s.step_error, 8.0, 1e-12);
  EXPECT_NEAR(s.native_step_error, 4.0, 1e-12);
  EXPECT_NEAR(s.model_gap + s.step_error - s.native_step_error, s.difference, 1e-12);
}

TEST(Split, SaysWhichSideDoesNotConverge) {
  const Extrapolation good = extrapolate({104.0, 102.0, 101.0});
  const Extrapolation bad = extrapolate({1.0, 2.0, 1.5});
  EXPECT_FALSE(split(good, bad).valid);
  EXPECT_EQ(split(good, bad).reason.rfind("MuJoCo", 0), 0U);
  EXPECT_EQ(split(bad, good).reason.rfind("native", 0), 0U);
  const Split s = split(good, bad);
  EXPECT_NEAR(s.model_gap + s.step_error - s.native_step_error, s.difference, 1e-12);
}

}  // namespace
}  // namespace rotorub
