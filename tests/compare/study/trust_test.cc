// The verdict on made-up figures.
#include "compare/study/trust.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rotorub {
namespace {

constexpr double kPercent = 0.01;

JudgedFigure made(const char* key, double deviation, double spread = 0.0) {
  return judged(figure(key), 100.0, 100.0 * (1.0 + deviation), spread, kPercent);
}

TEST(FigureVerdict, ToleranceAndSpreadDecide) {
  struct Case {
    double deviation, spread;
    FigureVerdict expected;
    const char* what;
  };
  for (const Case& c : {Case{0.005, 0.0, FigureVerdict::kWithin, "near, and repeatable"},
                        Case{-0.02, 0.0, FigureVerdict::kOutside, "far, and repeatable"},
                        Case{0.02, 0.005, FigureVerdict::kOutside, "far beyond the twins"},
                        Case{0.02, 0.03, FigureVerdict::kUndecidable, "as far as twins are"},
                        Case{0.001, 0.03, FigureVerdict::kUndecidable, "near by luck"},
                        Case{3.0, 0.03, FigureVerdict::kOutside, "no twin is that far"}}) {
    EXPECT_EQ(made("mean_force", c.deviation, c.spread).verdict, c.expected) << c.what;
  }
}

TEST(FigureVerdict, WhatIsNoNumberIsOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged(figure("mean_force"), 1.0, nan, 0.0, kPercent).verdict, FigureVerdict::kOutside);
  EXPECT_EQ(judged(figure("peak_force"), 0.0, 1.0, 0.0, kPercent).verdict, FigureVerdict::kOutside);
}

TEST(FigureVerdict, OthersAreNotJudged) {
  EXPECT_EQ(made("force_deviation", 5.0).verdict, FigureVerdict::kNotJudged);
}

// A gap that all but rests has a rate that no ratio is worth looking at.
TEST(FigureVerdict, ASmallGapRateIsJudgedByItsResolution) {
  const Figure& rate = figure("gap_rate_rms");
  EXPECT_EQ(judged(rate, 0.0, 1e-8, 0.0, kPercent).verdict, FigureVerdict::kWithin);
  EXPECT_DOUBLE_EQ(deviation(rate, 0.0, 1e-5), 0.01);
  EXPECT_DOUBLE_EQ(deviation(rate, 1e-3, 2e-3), 1.0);
}

TEST(Spread, IsGreatestLessLeast) {
  EXPECT_DOUBLE_EQ(spread(figure("mean_force"), {100.0, 103.0, 98.0}), 0.05);
  EXPECT_NEAR(spread(figure("contact_fraction"), {0.5, 0.52, 0.51}), 0.02, 1e-15);
  EXPECT_EQ(spread(figure("mean_force"), {7.0}), 0.0);
  EXPECT_EQ(spread(figure("mean_force"), {}), 0.0);
}

TEST(Trust, PeaksAloneLeaveTheAverages) {
  const auto all = [](double mean, double peak, double impacts, double spread) {
    return std::vector{made("mean_force", mean), made("peak_force", peak),
                       made("hard_impacts", impacts, spread)};
  };
  EXPECT_EQ(trust(all(0.0, 0.0, 0.0, 0.0)), Trust::kYes);
  EXPECT_EQ(trust(all(0.001, -0.89, 0.0, 0.0)), Trust::kAveragesOnly);
  EXPECT_EQ(trust(all(0.001, 0.0, 0.2, 0.0)), Trust::kAveragesOnly);
  EXPECT_EQ(trust(all(0.001, 0.0, 0.02, 0.07)), Trust::kYes) << "undecidable does not decide";
  EXPECT_EQ(trust(all(0.2, 0.0, 0.0, 0.0)), Trust::kNo);
  EXPECT_EQ(trust({made("mean_force", 0.0, 0.1)}), Trust::kUndecidable) << "nothing decided";
}

TEST(Why, NamesTheFurthestFirstAndWhatWasNotDecided) {
  const std::string text = why({made("mean_force", 0.001), made("hard_impacts", 0.2),
                                made("peak_force", -0.89), made("gap_rate_rms", 0.03, 0.07)},
                               kPercent);
  EXPECT_EQ(text,
            "peak force -89 %, hard impacts +20 %; within 1 %: mean normal force; undecidable at 1 "
            "%: rms gap rate (repeats to 7.00 %)");
}

}  // namespace
}  // namespace rotorub
