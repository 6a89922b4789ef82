#include "compare/measured/clipping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace rotorub {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kSize = 1e-3;  // m, of the sines below

MeasuredRecord record_of(const char* name, std::size_t count,
                         const std::function<double(double)>& value) {
  MeasuredRecord record;
  MeasuredColumn column;
  for (const Measurable& m : measurables()) {
    if (m.name == name) column.what = &m;
  }
  for (std::size_t k = 0; k < count; ++k) {
    record.t.push_back(static_cast<double>(k) / 20e3);
    column.value.push_back(value(record.t.back()));
    column.sample.push_back(Sample::kGood);
  }
  record.columns.push_back(column);
  return record;
}

std::size_t clipped(MeasuredRecord record) {
  mark_clipped(record);
  return record.columns.front().count(Sample::kClipped);
}

double sine(double t) { return kSize * std::sin(kTurn * 53.0 * t); }
double rounded_to(double value, double quantum) { return quantum * std::round(value / quantum); }

TEST(Clipping, MarksTheSamplesAtTheLimitAndNoOther) {
  for (const double limit : {0.5 * kSize, 0.9 * kSize, 0.99 * kSize}) {
    SCOPED_TRACE(limit);
    MeasuredRecord record =
        record_of("rotor_x", 4000, [&](double t) { return std::clamp(sine(t), -limit, limit); });
    mark_clipped(record);
    const MeasuredColumn& c = record.columns.front();
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < record.t.size(); ++i) {
      EXPECT_EQ(c.sample[i] == Sample::kClipped, std::abs(sine(record.t[i])) >= limit) << i;
      beyond += std::abs(sine(record.t[i])) >= limit ? 1 : 0;
    }
    EXPECT_GT(beyond, 100u);
  }
}

// A peak of a converter's whole numbers is flat, and no limit.
TEST(Clipping, LeavesPeaksOfRoundedValues) {
  for (const double bits : {8.0, 12.0, 16.0}) {
    const double quantum = kSize / std::pow(2.0, bits - 1.0);
    EXPECT_EQ(
        clipped(record_of("rotor_x", 4000, [&](double t) { return rounded_to(sine(t), quantum); })),
        0u)
        << bits;
  }
}

TEST(Clipping, FindsTheLimitOfRoundedValues) {
  const double quantum = kSize / 2048.0, limit = 1500.0 * quantum;
  const auto value = [&](double t) {
    return std::clamp(rounded_to(sine(t), quantum), -limit, limit);
  };
  std::size_t beyond = 0;
  for (std::size_t k = 0; k < 4000; ++k)
    beyond += std::abs(value(static_cast<double>(k) / 20e3)) == limit ? 1 : 0;
  EXPECT_EQ(clipped(record_of("rotor_x", 4000, value)), beyond);
}

TEST(Clipping, LeavesWhatIsFlatForOtherReasons) {
  EXPECT_EQ(clipped(record_of("rotor_x", 4000, sine)), 0u) << "nothing is flat";
  EXPECT_EQ(
      clipped(record_of("force", 4000, [](double t) { return std::max(0.0, 1e5 * sine(t)); })), 0u)
      << "a force without contact is 0";
  EXPECT_EQ(clipped(record_of("ring_x", 4000,
                              [](double t) { return t < 0.05 ? 2e-6 : 2e-6 - 1e-3 * (t - 0.05); })),
            0u)
      << "a ring at rest until it is hit";
  EXPECT_EQ(clipped(record_of("rotor_x", 4000, [](double) { return 1e-3; })), 0u) << "a constant";
  EXPECT_EQ(
      clipped(record_of("rotor_x", 4000, [](double t) { return sine(std::floor(t * 2e3) / 2e3); })),
      0u)
      << "a sensor ten times slower than its record";
  EXPECT_EQ(clipped(record_of("current_1", 4000,
                              [](double t) { return std::clamp(5e3 * sine(t), -3.0, 3.0); })),
            0u)
      << "an amplifier's limit is the machine's";
}

// A whirl that grows into the limit: its last peak alone, to where the record ends.
TEST(Clipping, FindsALimitThatTheRecordEndsAt) {
  constexpr std::size_t kToThePeak = 2736;
  constexpr double kLimit = 0.85 * kSize;
  const auto growing = [](double t) { return t / 0.15 * sine(t); };
  std::size_t beyond = 0;
  for (std::size_t k = 0; k < kToThePeak; ++k)
    beyond += growing(static_cast<double>(k) / 20e3) >= kLimit ? 1 : 0;
  EXPECT_GT(beyond, 15u);
  EXPECT_EQ(clipped(record_of("rotor_x", kToThePeak,
                              [&](double t) { return std::min(growing(t), kLimit); })),
            beyond);
}

// Straight from no force to the limit: nothing beside it bends towards it.
TEST(Clipping, FindsTheLimitOfPulses) {
  const auto pulses = [](double t) {
    return std::fmod(t, 0.01) < 0.0005  ? 500.0
           : std::fmod(t, 0.01) < 0.001 ? 3e5 * t - std::floor(3e5 * t)
                                        : 0.0;
  };
  std::size_t at_limit = 0;
  for (std::size_t k = 0; k < 4000; ++k)
    at_limit += pulses(static_cast<double>(k) / 20e3) == 500.0 ? 1 : 0;
  MeasuredRecord record = record_of("force", 4000, pulses);
  EXPECT_GT(at_limit, 50u);
  EXPECT_EQ(clipped(record), at_limit);
}

}  // namespace
}  // namespace rotorub
