// The choice of the alignment if the motion is nearly a circle, or the run shorter than the record:
// the one that the data determine, and none that they contradict.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "compare/measured/alignment.h"
#include "compare/measured/reader.h"
#include "tests/compare/hand_made.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

using Place = std::function<std::complex<double>(double t)>;
constexpr double kPerDegree = std::numbers::pi / 180.0;
constexpr double kSpin = 2.0 * std::numbers::pi * 60.0;  // rad/s

std::complex<double> small_circle(double t) { return 29e-6 * std::polar(1.0, kSpin * t); }

// A pump that loses a part of a blade: a small circle, a transient, and in the end a large circle.
std::complex<double> lost_blade(double t) {
  constexpr double kLost = 0.083;  // s
  if (t < kLost) return small_circle(t);
  const std::complex<double> large = 435e-6 * std::polar(1.0, kSpin * t + 0.7);
  const std::complex<double> jump =
      small_circle(kLost) - 435e-6 * std::polar(1.0, kSpin * kLost + 0.7);
  return large + jump * std::exp(std::complex<double>(-20.0, 1.6 * kSpin) * (t - kLost));
}

// Rows every 20 us up to `end`.
Trajectory run_of(const Place& place, double end) {
  constexpr double kApart = 2e-5;
  return moving(static_cast<std::size_t>(std::llround(end / kApart)) + 1, kApart, place);
}

struct Seen {
  double from = 0.0, end = 0.42;  // s
  double shift = -1151.5e-3;      // s, that found is right
  double angle = 0.0;             // rad, that found is right
  double gain = 1.0, noise = 0.0;
};

// A record of the run, with samples 420 us apart.
MeasuredRecord sensed(const Place& place, const Seen& seen) {
  std::mt19937 bits(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::string text = "t [s],rotor_x [m],rotor_y [m]\n";
  for (double t = seen.from; t <= seen.end; t += 420e-6) {
    const std::complex<double> z = seen.gain * place(t) * std::polar(1.0, -seen.angle) +
                                   seen.noise * std::complex<double>(normal(bits), normal(bits));
    text += fmt::format("{:.17g},{:.17g},{:.17g}\n", t - seen.shift, z.real(), z.imag());
  }
  return parse_measured(text, "seen.csv");
}

// The reason of the refusal; empty if the record is accepted.
std::string refusal(const Trajectory& run, const MeasuredRecord& record) {
  return message_of<MeasuredError>([&] { align(record, SampledRun(run), {}); });
}

// Any two circles correlate, whatever their sizes: aligning half the run with a late part of the
// record is wrong if the whole run does not fit there. With an angle of 0 the data still determine
// the shift.
TEST(AlignmentChoice, ARunShorterThanItsRecordIsFoundInAnyFrame) {
  const Trajectory run = run_of(lost_blade, 0.15);
  for (const double angle : {0.0, 20.0, 45.0, 90.0, -135.0}) {
    for (const double noise : {0.0, 1.3e-6}) {
      SCOPED_TRACE(fmt::format("{} deg, {} m", angle, noise));
      const Alignment a = align(sensed(lost_blade, {.angle = angle * kPerDegree, .noise = noise}),
                                SampledRun(run), {});
      EXPECT_EQ(a.angle_from, AngleFrom::kFound);
      EXPECT_NEAR(a.shift, -1151.5e-3, noise > 0.0 ? 5.0 * a.shift_error.value() : 1e-7);
      EXPECT_NEAR(a.angle, angle * kPerDegree, noise > 0.0 ? 5.0 * a.angle_error.value() : 1e-4);
      EXPECT_LT(a.residual.value(), noise > 0.0 ? 0.02 : 1e-3);
      EXPECT_EQ(alignment_text(a).find("circle,"), std::string::npos) << alignment_text(a);
    }
  }
}

// A frame that the run determines only through noise stays undetermined.
TEST(AlignmentChoice, ACircleInNoiseStaysACircle) {
  const Trajectory run = run_of(small_circle, 0.15);
  for (const double angle : {0.0, 70.0}) {
    const Alignment a =
        align(sensed(small_circle, {.end = 0.12, .angle = angle * kPerDegree, .noise = 1e-6}),
              SampledRun(run), {});
    EXPECT_EQ(a.angle_from, AngleFrom::kCircle) << angle;
    EXPECT_EQ(a.angle, 0.0) << angle;
  }
  // An ellipse that the sensors cause: the residual is not noise, and determines no angle.
  const Place ellipse = [](double t) {
    return small_circle(t) + 0.05 * std::conj(small_circle(t));
  };
  const Alignment a = align(sensed(ellipse, {.end = 0.12}), SampledRun(run), {});
  EXPECT_EQ(a.angle_from, AngleFrom::kCircle);
}

// The motions have the same shape, but one is seven times as large; the correlation alone would
// accept it.
TEST(AlignmentChoice, RefusesAMotionOfAnotherSize) {
  const Place blow = [](double t) { return lost_blade(t + 0.083); };
  const Trajectory run = run_of(blow, 0.1);
  for (const double gain : {7.0, 1.0 / 7.0}) {
    const std::string reason = refusal(run, sensed(blow, {.end = 0.1, .gain = gain}));
    EXPECT_NE(reason.find(fmt::format("{:.3g} times as large", gain)), std::string::npos) << reason;
    EXPECT_NE(reason.find("the scene or the units may be wrong"), std::string::npos) << reason;
    EXPECT_NE(reason.find("--measured-shift"), std::string::npos) << reason;
  }
  const MeasuredRecord larger = sensed(blow, {.end = 0.1, .gain = 1.8});
  EXPECT_EQ(refusal(run, larger), "");
  const std::string text = alignment_text(align(larger, SampledRun(run), {}));
  EXPECT_NE(text.find("the record moves 1.8 times as far as the run"), std::string::npos) << text;
  // The given angle is used, however bad.
  EXPECT_NO_THROW(align(sensed(blow, {.end = 0.1, .gain = 7.0}), SampledRun(run),
                        {.shift = -1151.5e-3, .angle = {}}));
}

// Another part of the record fits as well as the part that equals the run; the output says that
// there is another.
TEST(AlignmentChoice, ReportsPartsOfAnotherShape) {
  const Trajectory run = run_of(lost_blade, 0.15);
  const Alignment a = align(sensed(lost_blade, {.gain = 5.0}), SampledRun(run), {});
  ASSERT_TRUE(a.other_size);
  EXPECT_GT(a.other_size->correlation, 0.99);
  EXPECT_NE(alignment_text(a).find("check its unit"), std::string::npos) << alignment_text(a);
}

}  // namespace
}  // namespace rotorub::test
