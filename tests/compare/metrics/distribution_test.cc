#include "compare/metrics/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace rotorub {
namespace {

TEST(Exceedance, CountsThoseThatReachAValue) {
  const Exceedance curve = exceedance({3.0, 1.0, 2.0, 2.0}, 100);
  EXPECT_EQ(curve.value, (std::vector<double>{3.0, 2.0, 2.0, 1.0}));
  EXPECT_EQ(curve.count, (std::vector<std::size_t>{1, 2, 3, 4}));
  EXPECT_TRUE(exceedance({}, 100).value.empty());
}

// 10,000 values k^-1/2: n reach v where v = n^-1/2.
TEST(Exceedance, OfManyKeepsTheLaw) {
  std::vector<double> values;
  for (int k = 10000; k >= 1; --k) values.push_back(1.0 / std::sqrt(k));
  const Exceedance curve = exceedance(values, 60);
  ASSERT_LE(curve.count.size(), 61u);
  EXPECT_GE(curve.count.size(), 40u);
  EXPECT_EQ(curve.count.front(), 1u);
  EXPECT_EQ(curve.count.back(), 10000u);
  for (std::size_t k = 0; k < curve.count.size(); ++k)
    EXPECT_DOUBLE_EQ(curve.value[k], 1.0 / std::sqrt(static_cast<double>(curve.count[k])));
}

// Every part of a ramp has the same time; the other half of the time there is no value.
TEST(Histogram, OfARampIsFlat) {
  const Histogram h = histogram({0.0, 1.0, 2.0}, {0.0, 0.0, 8.0}, 4);
  EXPECT_DOUBLE_EQ(h.width, 2.0);
  for (const double share : h.share) EXPECT_DOUBLE_EQ(share, 0.125);
}

// The time of a sine above 0 between two values is that of arc sine.
TEST(Histogram, OfASineIsItsArcSine) {
  std::vector<double> t, y;
  for (int k = 0; k <= 20000; ++k) {
    t.push_back(k * 1e-4 * std::numbers::pi);
    y.push_back(std::sin(t.back()) > 1e-12 ? std::sin(t.back()) : 0.0);
  }
  const Histogram h = histogram(t, y, 10);
  for (std::size_t k = 0; k < 10; ++k) {
    const double low = 0.1 * static_cast<double>(k);
    const double exact = (std::asin(std::min(1.0, low + 0.1)) - std::asin(low)) / std::numbers::pi;
    EXPECT_NEAR(h.share[k], exact, 2e-5) << k;
  }
  EXPECT_NEAR(std::accumulate(h.share.begin(), h.share.end(), 0.0), 0.5, 1e-4);
}

TEST(Histogram, HoldsAConstantAndNothing) {
  const Histogram h = histogram({0.0, 1.0}, {5.0, 5.0}, 4);
  EXPECT_EQ(h.share, (std::vector<double>{0.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(histogram({0.0, 1.0}, {0.0, 0.0}, 2).share, (std::vector<double>{0.0, 0.0}));
}

}  // namespace
}  // namespace rotorub
