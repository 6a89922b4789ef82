// Intervals at the ends of what there is; all others stand beside scipy's in
// tests/package/statistics_test.py.
#include "compare/sweep/group_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rotorub::sweep {
namespace {

// P(x_(1) < median < x_(n)) = 1 - 2 / 2^n.
TEST(QuantileOf, OfFewValuesReachesTheirEndsOrHasNoBounds) {
  const std::vector<double> one{7.0}, five{1.0, 2.0, 3.0, 4.0, 5.0};
  EXPECT_EQ(quantile_of(five, 0.5, 0.9).low, 1.0) << "1/32 below";
  EXPECT_EQ(quantile_of(five, 0.5, 0.9).high, 5.0);
  EXPECT_FALSE(quantile_of(five, 0.5, 0.95).low) << "0.025 < 1/32";
  EXPECT_EQ(quantile_of(one, 0.9, 0.9).value, 7.0);
  EXPECT_FALSE(mean_of(one, 0.9).low);
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
