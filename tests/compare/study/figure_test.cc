#include "compare/figures/figure.h"

#include <gtest/gtest.h>

#include <limits>

#include <set>

#include "compare/base/format.h"
#include "compare/metrics/extrapolation.h"

namespace rotorub {
namespace {

TEST(Figures, AveragesAndSingleMomentsAreJudged) {
  std::set<std::string> averages, peaks, keys;
  for (const Figure& f : figures()) {
    EXPECT_TRUE(keys.insert(f.key).second) << f.key;
    if (f.judged == Judged::kAverage) averages.insert(f.key);
    if (f.judged == Judged::kPeak) peaks.insert(f.key);
    EXPECT_EQ(f.is_judged(), f.judged != Judged::kNo) << f.key;
  }
  EXPECT_EQ(averages,
            (std::set<std::string>{"mean_force", "lasting_fraction", "impulse_total",
                                   "friction_work", "whirl_frequency", "spin_speed", "ring_speed",
                                   "control_force", "near_miss", "contact_time"}));
  EXPECT_EQ(peaks, (std::set<std::string>{"impact_impulse", "window_impulse", "gap_rate_rms",
                                          "hard_impacts", "contact_peak", "contact_depth"}));
}

TEST(Figures, DeviationIsRelativeOrInPoints) {
  const Figure& force = figure("mean_force");
  EXPECT_DOUBLE_EQ(deviation(force, 200.0, 190.0), -0.05);
  EXPECT_EQ(deviation(force, 0.0, 0.0), 0.0);
  for (const double other : {1.0, -1.0})
    EXPECT_EQ(deviation(force, 0.0, other), std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(deviation(figure("contact_fraction"), 1.0, 0.25), -0.75);
  // Work is negative: more of it is a larger magnitude.
  EXPECT_DOUBLE_EQ(deviation(figure("friction_work"), -10.0, -11.0), 0.1);
}

TEST(Figures, AreWrittenInTheirUnits) {
  EXPECT_EQ(figure_value(figure("contact_fraction"), 0.9995), "99.95");
  EXPECT_EQ(figure_value(figure("max_penetration"), 12.5e-6), "12.50");
  EXPECT_EQ(figure_value(figure("impacts"), 665.0), "665");
  EXPECT_EQ(figure_value(figure("near_miss"), std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(Figures, DeviationsAreWrittenWithTheirScale) {
  const Figure& force = figure("mean_force");
  EXPECT_EQ(deviation_text(force, 0.0052), "+0.52 %");
  EXPECT_EQ(deviation_text(force, -0.77), "-77 %");
  EXPECT_EQ(deviation_text(force, 187.0), "×188");
  EXPECT_EQ(deviation_text(force, 1e-6), "0.00 %");
  EXPECT_EQ(deviation_text(figure("contact_fraction"), -0.77), "-77 points");
  EXPECT_EQ(deviation_text(figure("max_penetration"), 3.0), "–");
  EXPECT_EQ(deviation_text(force, std::numeric_limits<double>::infinity()), "+∞");
}

TEST(Format, SizesHaveNoSign) {
  const Figure& force = figure("mean_force");
  EXPECT_EQ(size_text(force, 0.068), "6.80 %");
  EXPECT_EQ(size_text(force, 1e-6), "0.00 %");
  EXPECT_EQ(size_text(force, 187.0), "18700 %") << "a size is no factor";
  EXPECT_EQ(size_text(force, std::numeric_limits<double>::infinity()), "∞");
}

// A percentage of the resolution would look like a percentage of the value.
TEST(Figures, DifferencesFromASmallValueAreWrittenInItsUnit) {
  const Figure& rate = figure("gap_rate_rms");  // resolution 1 mm/s
  EXPECT_TRUE(is_in_units(rate, 0.5301e-3));
  EXPECT_FALSE(is_in_units(rate, 1e-3));
  EXPECT_EQ(deviation_text(rate, 0.5301e-3, deviation(rate, 0.5301e-3, 0.5688e-3)), "+0.0387 mm/s");
  EXPECT_EQ(deviation_text(rate, 0.5301e-3, deviation(rate, 0.5301e-3, 0.1022)), "+102 mm/s");
  EXPECT_EQ(deviation_text(rate, 0.02, deviation(rate, 0.02, 0.0214)), "+7.00 %");
  EXPECT_EQ(size_text(rate, 0.5e-3, 0.032), "0.032 mm/s");
  EXPECT_EQ(deviation_text(figure("hard_impacts"), 30.0, 0.4), "+12");
  EXPECT_EQ(deviation_text(figure("hard_impacts"), 600.0, 0.4), "+40 %");
  EXPECT_EQ(deviation_text(figure("lasting_fraction"), 0.0, 0.4), "+40 points");
  // Work is negative: more of it is a larger magnitude, but a smaller number.
  EXPECT_EQ(deviation_text(figure("friction_work"), -5e-4, 0.2), "-0.0002 J");
}

TEST(Format, WordsAreWrapped) {
  const std::string word(30, 'w');
  EXPECT_EQ(wrapped("- ", "one two"), "- one two\n");
  // A character is one column, whatever its number of bytes.
  const std::string micro = "1 " + std::string(77, 'a') + "µ";
  EXPECT_EQ(wrapped("", micro), "1 " + std::string(77, 'a') + "µ\n");
  EXPECT_EQ(wrapped("  - ", word + " " + word + "\n" + word),
            "  - " + word + " " + word + "\n    " + word + "\n");
  // The indent is shorter than the lead: the first word also goes to the next line if it fits
  // there.
  const std::string lead = std::string(60, 'l') + ": ";
  EXPECT_EQ(wrapped(lead, word + " end", 6), std::string(60, 'l') + ":\n      " + word + " end\n");
  // A word that is too long for a line has its own line.
  const std::string longest(100, 'x');
  EXPECT_EQ(wrapped("- ", longest + " " + longest), "- " + longest + "\n  " + longest + "\n");
}

TEST(Format, ShortNumbers) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(3.0), "3");
  EXPECT_EQ(short_number(48.9999), "49.00");
  EXPECT_EQ(short_number(-0.011234), "-0.01123");
  EXPECT_EQ(short_number(12269.4), "12269");
  EXPECT_EQ(short_number(1.234e-7), "1.23e-07");
  EXPECT_EQ(short_number(-std::numeric_limits<double>::infinity()), "-∞");
}

TEST(Format, Times) {
  EXPECT_EQ(time_text(1e-5), "10 µs");
  EXPECT_EQ(time_text(2.5e-3), "2.5 ms");
  EXPECT_EQ(time_text(0.5), "0.5 s");
}

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
