// Intervals with closed forms; beside scipy: tests/package/statistics_test.py.
#include "compare/sweep/group_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace rotorub::sweep {
namespace {

std::vector<double> first(int n) {
  std::vector<double> all;
  for (int k = 1; k <= n; ++k) all.push_back(k);
  return all;
}

// P(x_(1) < median < x_(n)) = 1 - 2 / 2^n.
TEST(QuantileOf, TheMedianLiesBetweenTheEnds) {
  const auto five = first(5);
  const Estimate median = quantile_of(five, 0.5, 0.9);
  EXPECT_EQ(median.value, 3.0);
  EXPECT_EQ(median.low, 1.0) << "1/32 below";
  EXPECT_EQ(median.high, 5.0);
  EXPECT_FALSE(quantile_of(five, 0.5, 0.95).low) << "0.025 < 1/32";
  EXPECT_FALSE(quantile_of(five, 0.5, 0.95).high);
  EXPECT_EQ(quantile_of(first(6), 0.5, 0.95).low, 1.0) << "1/64";
}

TEST(QuantileOf, LiesLinearlyBetweenTwoValues) {
  const std::vector<double> two{10.0, 20.0};
  EXPECT_DOUBLE_EQ(quantile_of(two, 0.25, 0.9).value, 12.5);
  EXPECT_EQ(quantile_of(std::vector<double>{7.0}, 0.9, 0.9).value, 7.0);
}

// Student's t of one degree of freedom is Cauchy's: its quantile is tan(pi (P - 1/2)).
TEST(MeanOf, OfTwoValuesHasTheTangent) {
  const std::vector<double> two{1.0, 4.0};
  const Estimate mean = mean_of(two, 0.9);
  EXPECT_EQ(mean.value, 2.5);
  const double half = std::tan(std::numbers::pi * 0.45) * 1.5;
  EXPECT_NEAR(*mean.high, 2.5 + half, 1e-12 * half);
  EXPECT_NEAR(*mean.low, 2.5 - half, 1e-12 * half);
  EXPECT_FALSE(mean_of(std::vector<double>{1.0}, 0.9).low);
  EXPECT_DOUBLE_EQ(deviation_of(two), 3.0 / std::sqrt(2.0));
}

// None of n: 1 - tail^(1/n) above; one of two: the roots of (1 - p)^2 = 1 - tail and p^2 = 1 -
// tail.
TEST(ShareOf, HasTheBoundsOfClopperAndPearson) {
  constexpr double kTail = 0.025;
  const Estimate none = share_of(0, 10, 0.95), one = share_of(1, 2, 0.95),
                 all = share_of(10, 10, 0.95);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(*none.high, 1.0 - std::pow(kTail, 0.1), 1e-12);
  EXPECT_NEAR(*all.low, std::pow(kTail, 0.1), 1e-12);
  EXPECT_EQ(all.high, 1.0);
  EXPECT_EQ(one.value, 0.5);
  EXPECT_NEAR(*one.low, 1.0 - std::sqrt(1.0 - kTail), 1e-12);
  EXPECT_NEAR(*one.high, std::sqrt(1.0 - kTail), 1e-12);
}

}  // namespace
}  // namespace rotorub::sweep
