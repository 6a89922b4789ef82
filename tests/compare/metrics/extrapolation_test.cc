#include "compare/metrics/extrapolation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rotorub {
namespace {

std::array<double, 3> ladder(double limit, double error, double order) {
  return {limit + error, limit + error / std::exp2(order), limit + error / std::exp2(2.0 * order)};
}

TEST(Extrapolation, FindsLimitAndOrder) {
  for (const double order : {1.0, 2.0}) {
    for (const double error : {0.3, -0.3}) {
      const Extrapolation e = extrapolate(ladder(7.0, error, order));
      EXPECT_TRUE(e.valid);
      EXPECT_NEAR(e.limit, 7.0, 1e-12);
      EXPECT_NEAR(e.order, order, 1e-12);
      EXPECT_NEAR(e.uncertainty, std::abs(error) / std::exp2(2.0 * order), 1e-12);
      EXPECT_TRUE(e.reason.empty());
    }
  }
}

TEST(Extrapolation, AFigureWithoutStepErrorIsItsOwnLimit) {
  for (const double value : {0.0, 5.0, -3.0}) {
    const Extrapolation e = extrapolate({value, value, value});
    EXPECT_TRUE(e.valid);
    EXPECT_EQ(e.limit, value);
    EXPECT_EQ(e.uncertainty, 0.0);
  }
}

TEST(Extrapolation, RefusesWhatIsNotMonotone) {
  const Extrapolation e = extrapolate({1.0, 1.2, 1.1});
  EXPECT_FALSE(e.valid);
  EXPECT_EQ(e.limit, 1.1);
  EXPECT_NEAR(e.uncertainty, 0.2, 1e-15);
  EXPECT_NE(e.reason.find("not monotone"), std::string::npos);
}

TEST(Extrapolation, RefusesWhatDoesNotConverge) {
  EXPECT_FALSE(extrapolate({1.0, 1.1, 1.3}).valid);         // grows as the step shrinks
  EXPECT_FALSE(extrapolate({1.0, 1.1, 1.19}).valid);        // hardly shrinks
  EXPECT_FALSE(extrapolate({1.0, 2.0, 2.0 + 1e-6}).valid);  // too good to be an order
  EXPECT_FALSE(extrapolate({1.0, 1.0, 1.1}).valid);
}

TEST(Extrapolation, RefusesWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Extrapolation e = extrapolate({1.0, nan, 1.0});
  EXPECT_FALSE(e.valid);
  EXPECT_NE(e.reason.find("finite"), std::string::npos);
}

}  // namespace
}  // namespace rotorub
