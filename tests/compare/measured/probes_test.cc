// Columns by the names of the file, and probes that do not stand along x and y.
#include "compare/measured/record.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "compare/measured/reader.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Place {
  double x, y;
};
Place place_at(int k) { return {3e-4 * std::cos(0.3 * k), 2e-4 * std::sin(0.3 * k + 0.4)}; }

// The signals of two probes along these directions, in mil, under names of a data logger.
std::string logged(double first, double second) {
  std::string text = "Time (ms);CH1 Probe [mils];CH2 Probe;Phase mark\n";
  for (int k = 0; k < 64; ++k) {
    const Place p = place_at(k);
    const auto seen = [&](double a) { return (std::cos(a) * p.x + std::sin(a) * p.y) / 25.4e-6; };
    text += fmt::format("{:.17g};{:.17g};{:.17g};{}\n", 0.05 * k, seen(first), seen(second), k % 7);
  }
  return text;
}

const std::vector<ColumnName> kNames{
    {"Time", "t"}, {"CH1 Probe", "rotor_x"}, {"CH2 Probe", "rotor_y [mil]"}};

std::string reason_of(const std::string& text, const std::vector<ColumnName>& names) {
  const auto refused = test::refusals([&] { parse_measured(text, "log.csv", names); });
  return refused.empty() ? "" : to_string(refused.front());
}

TEST(ColumnNames, AreThoseOfTheFile) {
  const MeasuredRecord record = parse_measured(logged(0.0, 90.0 * kDegree), "log.csv", kNames);
  EXPECT_NEAR(record.interval, 0.05e-3, 1e-12);
  ASSERT_EQ(record.columns.size(), 2u);
  EXPECT_EQ(record.columns[0].header, "CH1 Probe [mils]");
  EXPECT_EQ(record.left_out, std::vector<std::string>{"Phase mark"});
  for (int k = 0; k < 64; ++k) {
    const auto i = static_cast<std::size_t>(k);
    EXPECT_NEAR(record.find("rotor_x")->value[i], place_at(k).x, 1e-12);
    EXPECT_NEAR(record.find("rotor_y")->value[i], place_at(k).y, 1e-12);
  }
}

TEST(ColumnNames, OfNoColumnAreRefused) {
  const std::string text = logged(0.0, 1.0);
  const std::vector<std::pair<std::vector<ColumnName>, std::string>> cases{
      {{}, "no such column"},
      {{}, "give for example --measured-column \"CH1 Probe = rotor_x [mils]\""},
      {{{"Time", "t"}, {"CH3", "rotor_x"}}, "the header has Time (ms)"},
      {{{"Time", "t"}, {"CH1 Probe", "rotor_z"}}, "did you mean rotor_"},
      {{{"Time", "t"}, {"CH1 Probe", "rotor_x"}, {"CH2 Probe", "rotor_x"}}, "twice"},
      {{{"Time", "t"}, {"CH1 Probe", "rotor_x [N]"}}, "expected a length"}};
  for (const auto& [names, says] : cases) EXPECT_TRUE(test::contains(reason_of(text, names), says));
  EXPECT_TRUE(test::contains(reason_of("t [ms],Probe A\n0,1\n", {}),
                             "--measured-column \"Probe A = rotor_x [um]\""));
  EXPECT_FALSE(test::contains(reason_of(text, {{"Time", "t"}, {"CH1 Probe", "rotor_z"}}),
                              "--measured-column"))
      << "which was used";
}

// API 670: 45 degrees to either side of the vertical; and any two other directions, also mirrored.
TEST(Probes, GiveThePlaceAlongXAndY) {
  for (const auto& [first, second] : {std::pair{45.0, 135.0}, std::pair{135.0, 45.0},
                                      std::pair{-30.0, 50.0}, std::pair{200.0, 80.0}}) {
    MeasuredRecord record =
        parse_measured(logged(first * kDegree, second * kDegree), "log.csv", kNames);
    resolve_probes(record, first * kDegree, second * kDegree);
    for (int k = 0; k < 64; ++k) {
      const auto i = static_cast<std::size_t>(k);
      EXPECT_NEAR(record.find("rotor_x")->value[i], place_at(k).x, 1e-12) << first;
      EXPECT_NEAR(record.find("rotor_y")->value[i], place_at(k).y, 1e-12) << first;
    }
  }
}

// Without a sample of one probe the position is unknown along both axes.
TEST(Probes, AHoleOfOneIsAHoleOfBoth) {
  MeasuredRecord record =
      parse_measured(logged(45.0 * kDegree, 135.0 * kDegree), "log.csv", kNames);
  record.columns[0].sample[3] = Sample::kMissing;
  record.columns[1].sample[5] = Sample::kClipped;
  resolve_probes(record, 45.0 * kDegree, 135.0 * kDegree);
  for (const MeasuredColumn& c : record.columns) {
    EXPECT_EQ(c.sample[3], Sample::kMissing);
    EXPECT_EQ(c.value[3], 0.0);
    EXPECT_EQ(c.sample[5], Sample::kClipped);
    EXPECT_EQ(c.count(Sample::kGood), 62u);
  }
}

TEST(Probes, ThatTellNoPlaceAreRefused) {
  const std::string text = logged(0.0, 1.0);
  MeasuredRecord both = parse_measured(text, "log.csv", kNames);
  EXPECT_THROW(resolve_probes(both, 0.3, 0.3 + 170.0 * kDegree), MeasuredError) << "in one line";
  MeasuredRecord one = parse_measured(text, "log.csv", {{"Time", "t"}, {"CH1 Probe", "rotor_x"}});
  EXPECT_THROW(resolve_probes(one, 0.0, 1.5), MeasuredError);
  MeasuredRecord none = parse_measured(text, "log.csv", {{"Time", "t"}, {"CH1 Probe", "gap"}});
  EXPECT_THROW(resolve_probes(none, 0.0, 1.5), MeasuredError);
}

}  // namespace
}  // namespace rotorub
