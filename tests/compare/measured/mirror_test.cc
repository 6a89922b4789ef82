// Sensors whose axes are mirrored or exchanged: the message, and that it is right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "compare/measured/alignment.h"
#include "tests/compare/measurement.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

// From rest into a rub; no two turns are alike.
const Trajectory& passive_run() {
  static const Trajectory run = run_at(shipped("paper_passive", {"run.end=0.12", "run.step=1e-5"}),
                                       instants({.from = 0.0, .to = 0.12, .rate = 50e3}));
  return run;
}

// The record of correctly mounted sensors of its rotor and ring, in a frame turned by `angle`.
MeasuredRecord right_record(double angle) {
  MeasuredRecord record = record_of(passive_run(), {.rate = 50e3, .shift = -0.7, .angle = angle});
  std::erase_if(record.columns,
                [](const MeasuredColumn& c) { return c.what->axis == Axis::kNone; });
  return record;
}

void mirror(MeasuredRecord& record) {
  for (MeasuredColumn& c : record.columns) {
    if (c.what->axis != Axis::kY) continue;
    for (double& value : c.value) value = -value;
  }
}

void exchange(MeasuredRecord& record) {
  for (MeasuredColumn& c : record.columns) {
    if (c.what->axis != Axis::kX) continue;
    auto y = std::find_if(record.columns.begin(), record.columns.end(),
                          [&](const MeasuredColumn& other) { return other.what == c.what + 1; });
    std::swap(c.value, y->value);
  }
}

std::string why_refused(const MeasuredRecord& record, std::optional<double> angle = {}) {
  return message_of<MeasuredError>(
      [&] { align(record, SampledRun(passive_run()), {.shift = {}, .angle = angle}); });
}

// The two directions of "--measured-probes=20deg,-70deg", rad.
std::pair<double, double> directions(const std::string& text) {
  const std::string flag = "--measured-probes=";
  const std::size_t at = text.find(flag);
  if (at == std::string::npos) return {0.0, 0.0};
  double first = 0.0, second = 0.0;
  std::sscanf(text.c_str() + at + flag.size(), "%lfdeg,%lfdeg", &first, &second);
  return {first * std::numbers::pi / 180.0, second * std::numbers::pi / 180.0};
}

// The remedy that the message names aligns the record.
void expect_remedy(MeasuredRecord record, const std::string& reason) {
  const auto [first, second] = directions(reason);
  resolve_probes(record, first, second);
  const Alignment a = align(record, SampledRun(passive_run()), {.shift = {}, .angle = 0.0});
  EXPECT_NEAR(a.shift, -0.7, 1e-7) << reason;
  EXPECT_LT(a.residual.value(), 2e-3) << reason;
}

TEST(Mirror, AMirroredAxisIsNamedWithItsRemedy) {
  for (const double angle : {0.0, 0.35}) {
    MeasuredRecord record = right_record(angle);
    mirror(record);
    const std::string reason = why_refused(record);
    EXPECT_NE(reason.find("y of the sensors mirrored"), std::string::npos) << reason;
    expect_remedy(record, reason);
  }
}

TEST(Mirror, ExchangedAxesAreNamedWithTheirRemedy) {
  MeasuredRecord record = right_record(0.0);
  exchange(record);
  const std::string reason = why_refused(record);
  EXPECT_NE(reason.find("x and y of the sensors exchanged"), std::string::npos) << reason;
  EXPECT_NE(reason.find("--measured-probes=90deg,0deg"), std::string::npos) << reason;
  expect_remedy(record, reason);
}

// With and without a given angle, and from wrong directions of the probes.
TEST(Mirror, IsFoundBesideWhatIsGiven) {
  MeasuredRecord record = right_record(0.0);
  mirror(record);
  EXPECT_NE(why_refused(record, 0.0).find("y of the sensors mirrored"), std::string::npos);

  MeasuredRecord probes = right_record(45.0 * std::numbers::pi / 180.0);  // 45 and 135 degrees
  MeasuredRecord told = probes;
  resolve_probes(told, 135.0 * std::numbers::pi / 180.0, 45.0 * std::numbers::pi / 180.0);
  const std::string reason = why_refused(told, 0.0);
  EXPECT_NE(reason.find("--measured-probes=45deg,135deg"), std::string::npos) << reason;
  expect_remedy(probes, reason);
}

// Correct sensors cause no suspicion, nor does a motion that no mirror explains.
TEST(Mirror, IsNotSuspectedWhereItExplainsNothing) {
  const Alignment a = align(right_record(0.2), SampledRun(passive_run()), {});
  EXPECT_FALSE(a.mirrored);
  MeasuredRecord still = right_record(0.0);
  for (MeasuredColumn& c : still.columns) {
    for (std::size_t i = 0; i < c.value.size(); ++i) c.value[i] = 1e-4 * std::sin(double(i * i));
  }
  const std::string reason = why_refused(still);
  EXPECT_NE(reason.find("the scene or the units may be wrong"), std::string::npos) << reason;
  EXPECT_EQ(reason.find("mirrored"), std::string::npos) << reason;
}

// A mirror does not change the gap, which may determine the alignment; then the record is accepted
// with a message.
TEST(Mirror, IsSaidOfWhatIsAccepted) {
  MeasuredRecord record = right_record(0.0);
  mirror(record);
  const Alignment a = align(record, SampledRun(passive_run()), {.shift = -0.7, .angle = 0.0});
  ASSERT_TRUE(a.mirrored);
  EXPECT_NE(alignment_text(a).find("--measured-probes=0deg,-90deg"), std::string::npos)
      << alignment_text(a);
}

}  // namespace
}  // namespace rotorub::test
