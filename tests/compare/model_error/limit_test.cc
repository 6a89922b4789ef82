// What figures tend to over the modes: sequences of known limit, and chance.
#include "compare/model_error/limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace rotorub {
namespace {

constexpr double kPercent = 0.01;
const std::vector<int> kModes{12, 16, 20, 24};

FigureLimit of(const char* key, const std::function<double(int)>& value, double spread = 0.0) {
  std::vector<double> values;
  for (const int n : kModes) values.push_back(value(n));
  return figure_limit(figure(key), kModes, values, kPercent, spread);
}

TEST(FigureLimit, WithinTheToleranceIsConverged) {
  const FigureLimit f = of("mean_force", [](int n) { return 59.6 + 1e-3 * n; });
  EXPECT_EQ(f.convergence, Convergence::kConverged);
  EXPECT_NEAR(f.error.value(), -12e-3 / 59.612, 1e-9) << "the first against the last";
  EXPECT_EQ(f.left, 0.0);
}

// 1 + 3/n: 20 % of the first value left out at 12 modes, a tenth of it beyond 24 exactly told.
TEST(FigureLimit, ASumOverModesIsATrendAndItsRestIsTold) {
  const FigureLimit f = of("peak_force", [](int n) { return 1.0 + 3.0 / n; });
  EXPECT_EQ(f.convergence, Convergence::kTrend);
  EXPECT_NEAR(f.error.value(), 0.2, 1e-12);
  EXPECT_NEAR(f.left.value(), -0.1, 1e-12);
  EXPECT_NEAR(f.last_change, (3.0 / 24 - 3.0 / 20) / 1.25, 1e-12);
}

// A station without a mass: its effective mass, and every impact, falls to nothing as 1/n.
TEST(FigureLimit, WhatRunsToZeroHasNoLimit) {
  const FigureLimit f = of("peak_force", [](int n) { return 3.0 / n; });
  EXPECT_EQ(f.convergence, Convergence::kNoLimit);
  EXPECT_FALSE(f.error.has_value());
  EXPECT_FALSE(f.left.has_value());
}

TEST(FigureLimit, WhatGrowsHasNoLimit) {
  EXPECT_EQ(of("hard_impacts", [](int n) { return 80.0 * n; }).convergence, Convergence::kNoLimit);
  EXPECT_EQ(of("hard_impacts", [](int n) { return n % 8 == 0 ? 900.0 : 1000.0; }).convergence,
            Convergence::kNoLimit)
      << "back and forth";
}

// The same values among twins that differ by as much: nothing but chance to be seen.
TEST(FigureLimit, ChangesWithinTheTwinsSpreadAreChance) {
  const auto value = [](int n) { return n % 8 == 0 ? 950.0 : 1000.0; };
  EXPECT_EQ(of("hard_impacts", value, 0.0).convergence, Convergence::kNoLimit);
  EXPECT_EQ(of("hard_impacts", value, 0.06).convergence, Convergence::kConverged);
}

TEST(FigureLimit, SharesOfTimeGoByPoints) {
  // From 2 % to 1.4 %: a third of it, but less than a point.
  const auto value = [](int n) { return 0.02 - 0.0005 * (n - 12); };
  EXPECT_EQ(of("contact_fraction", value).convergence, Convergence::kConverged);
  EXPECT_NEAR(of("contact_fraction", value).error.value(), 0.006, 1e-12);
}

TEST(FigureLimit, NothingAtAllIsConverged) {
  EXPECT_EQ(of("hard_impacts", [](int) { return 0.0; }).convergence, Convergence::kConverged);
  const FigureLimit from_nothing = of("hard_impacts", [](int n) { return n - 12.0; });
  EXPECT_EQ(from_nothing.convergence, Convergence::kNoLimit);
  EXPECT_FALSE(from_nothing.error.has_value()) << "no share of nothing";
}

}  // namespace
}  // namespace rotorub
