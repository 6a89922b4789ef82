#include "compare/measured/record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "compare/measured/reader.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"

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

// The number of instants for which this is true.
std::size_t count(std::size_t instants, const std::function<bool(double)>& is) {
  std::size_t sum = 0;
  for (std::size_t k = 0; k < instants; ++k) sum += is(static_cast<double>(k) / 20e3) ? 1 : 0;
  return sum;
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

// A peak of a converter's whole numbers is flat, but not clipped.
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
  EXPECT_EQ(clipped(record_of("rotor_x", 4000, value)),
            count(4000, [&](double t) { return std::abs(value(t)) == limit; }));
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

// A whirl that grows into the limit: only its last peak is clipped, up to the end of the record.
TEST(Clipping, FindsALimitThatTheRecordEndsAt) {
  constexpr std::size_t kToThePeak = 2736;
  constexpr double kLimit = 0.85 * kSize;
  const auto growing = [](double t) { return t / 0.15 * sine(t); };
  const std::size_t beyond = count(kToThePeak, [&](double t) { return growing(t) >= kLimit; });
  EXPECT_GT(beyond, 15u);
  EXPECT_EQ(clipped(record_of("rotor_x", kToThePeak,
                              [&](double t) { return std::min(growing(t), kLimit); })),
            beyond);
}

// The force jumps from 0 to the limit: no sample beside it bends towards it.
TEST(Clipping, FindsTheLimitOfPulses) {
  const auto pulses = [](double t) {
    return std::fmod(t, 0.01) < 0.0005  ? 500.0
           : std::fmod(t, 0.01) < 0.001 ? 3e5 * t - std::floor(3e5 * t)
                                        : 0.0;
  };
  const std::size_t at_limit = count(4000, [&](double t) { return pulses(t) == 500.0; });
  EXPECT_GT(at_limit, 50u);
  EXPECT_EQ(clipped(record_of("force", 4000, pulses)), at_limit);
}

// kLeastSamples lines, the first of which stands in `first`.
std::string with_lines(const std::string& header, const std::string& first,
                       const std::string& separator = ",") {
  std::string text = header + "\n" + first + "\n";
  for (std::size_t k = 1; k < kLeastSamples; ++k) text += std::to_string(k) + separator + "1\n";
  return text;
}

TEST(MeasuredReader, TakesUnitsToSiAndKeepsHoles) {
  std::string text =
      "# rig 2\n t [ms], \"rotor_x [µm]\", rotor_y (mm), force [kN], spin_speed [rpm]\n\n";
  for (int k = 0; k < 20; ++k)
    text += k == 3 ? "1.5,,0.25,,\n" : std::to_string(0.5 * k) + ", +12.5, -0.25 ,1e-3,3000\n";
  const MeasuredRecord r = parse_measured(text, "rig.csv");
  ASSERT_EQ(r.t.size(), 20u);
  EXPECT_DOUBLE_EQ(r.t[2], 1e-3);
  EXPECT_DOUBLE_EQ(r.interval, 0.5e-3);
  const MeasuredColumn *x = r.find("rotor_x"), *y = r.find("rotor_y"), *f = r.find("force"),
                       *n = r.find("spin_speed");
  ASSERT_TRUE(x && y && f && n);
  EXPECT_DOUBLE_EQ(x->value[0], 12.5e-6);
  EXPECT_DOUBLE_EQ(y->value[0], -0.25e-3);
  EXPECT_DOUBLE_EQ(f->value[0], 1.0);
  EXPECT_NEAR(n->value[0], 314.159265, 1e-6);
  EXPECT_EQ(x->sample[3], Sample::kMissing);
  EXPECT_EQ(y->sample[3], Sample::kGood);
  EXPECT_DOUBLE_EQ(y->value[3], 0.25e-3);
  EXPECT_EQ(f->count(Sample::kMissing), 1u);
}

TEST(MeasuredReader, TakesTheWaysOfOtherPrograms) {
  const std::string lines = "\r\n0,5;1,25\r\n";
  std::string text = "\xEF\xBB\xBFt [s];ring_x [mm]" + lines;
  for (int k = 1; k < 20; ++k) text += std::to_string(k) + ",5;1,25\r\n";
  const MeasuredRecord german = parse_measured(text, "a.csv");
  EXPECT_DOUBLE_EQ(german.t[1], 1.5);
  EXPECT_DOUBLE_EQ(german.find("ring_x")->value[0], 1.25e-3);

  for (const char* first : {"0\t2", "0\t2\t"}) {  // also with a tab at the end
    const std::string tabs = with_lines("t [s]\tgap [um]", first, "\t");
    EXPECT_DOUBLE_EQ(parse_measured(tabs, "a.csv").find("gap")->value[0], 2e-6);
  }
}

TEST(MeasuredReader, PassesOverWhatAnInstrumentWritesBeforeTheHeader) {
  const std::string before = "Model,DPO2024\nSerial;C000\n\n\"Record length\",20,points\n";
  const MeasuredRecord r =
      parse_measured(before + with_lines("Time [ms],gap [um]", "0,2"), "a.csv");
  EXPECT_DOUBLE_EQ(r.t[3], 3e-3);
  EXPECT_DOUBLE_EQ(r.find("gap")->value[0], 2e-6);
  // Lines are counted from the first of the file.
  const auto refused = test::refusals(
      [&] { parse_measured(before + with_lines("Time [ms],gap [um]", "0,x"), "a.csv"); });
  ASSERT_FALSE(refused.empty());
  EXPECT_EQ(refused.front().line, 6);
}

TEST(MeasuredReader, TakesTheTimesThatItIsTold) {
  std::string text = "Time [s],Clock,gap [um]\n";
  for (int k = 0; k < 20; ++k) text += "12," + std::to_string(k) + ",1\n";
  const MeasuredRecord r = parse_measured(text, "a.csv", {{"Clock", "t [ms]"}, {"gap", "gap"}});
  EXPECT_DOUBLE_EQ(r.t[2], 2e-3);
  EXPECT_EQ(r.left_out, std::vector<std::string>{"Time [s]"});
}

// Its columns have no units; columns that are not compared are named, foreign ones are refused.
TEST(MeasuredReader, TakesTheProductsOwnSeriesInSi) {
  std::string text = "t,rotor_x,stator_y,gap_rate,mode,x_1,torsion_speed_2\n";
  for (int k = 0; k < 20; ++k) text += std::to_string(k) + ",0.5,0.25,1,slide,2,3\n";
  const MeasuredRecord r = parse_measured(text, "series.csv");
  EXPECT_FALSE(r.has_units);
  EXPECT_DOUBLE_EQ(r.find("rotor_x")->value[4], 0.5);
  EXPECT_DOUBLE_EQ(r.find("ring_y")->value[4], 0.25);
  EXPECT_EQ(r.left_out, (std::vector<std::string>{"gap_rate", "mode", "x_1", "torsion_speed_2"}));
}

struct Refused {
  const char* name;
  std::string text;
  int line;             // of the first fault
  const char* key;      // of it
  const char* says;     // within it
  const char* accepts;  // as well
};

TEST(MeasuredReader, RefusesWithLineColumnReasonAndWhatIsAccepted) {
  const std::string good = "t [s],gap [um]";
  const std::vector<Refused> all = {
      {"empty file", "", 0, "", "is empty", "a header and a line for each sample"},
      {"comments alone", "# nothing\n", 0, "", "is empty", "expected"},
      {"no time", with_lines("clock [s],gap [um]", "0,1"), 1, "clock", "no such column",
       "choose from t, rotor_x"},
      {"unknown column", with_lines("t [s],rotorx [um]", "0,1"), 1, "rotorx",
       "did you mean rotor_x?", "choose from t, rotor_x"},
      {"column twice", with_lines("t [s],ring_x [um],stator_x [um]", "0,1,1"), 1, "stator_x",
       "appears twice", "remove one of them"},
      {"time twice", with_lines("t [s],t [ms],gap [um]", "0,1,1"), 1, "t", "appears twice",
       "remove one of them"},
      {"no name", with_lines("t [s],[um]", "0,1"), 1, "column 2", "has no name", "choose from t"},
      {"unit of another quantity", with_lines("t [s],gap [N]", "0,1"), 1, "gap", "length", "mm"},
      {"no such unit", with_lines("t [s],gap [furlong]", "0,1"), 1, "gap", "furlong", "mm"},
      {"a bracket that is open", with_lines("t [s],gap [mm", "0,1"), 1, "gap", "not closed",
       "rotor_x [um]"},
      {"words behind the unit", with_lines("t [s],gap [mm] p-p", "0,1"), 1, "gap", "not closed",
       "rotor_x [um]"},
      {"peak to peak", with_lines("t [s],gap (mil pp)", "0,1"), 1, "gap",
       "`mil pp` is the unit of an amplitude", "--measured-column \"gap = gap [mil]\""},
      {"a logger's y", with_lines("t [s],CH1 Y (mil pp)", "0,1"), 1, "CH1 Y", "no such column",
       "--measured-column \"CH1 Y = rotor_y [mil]\""},
      {"empty unit", with_lines("t [s],gap []", "0,1"), 1, "gap", "no unit", "m, mm, um"},
      {"one without a unit", with_lines("t [s],gap", "0,1"), 1, "gap",
       "has no unit, but other columns have", "gap [m]"},
      {"time alone", with_lines("t [s]", "0"), 1, "", "nothing measured", "choose from"},
      {"a word", with_lines(good, "0,high"), 2, "gap [um]", "`high` is not a number",
       "an empty field is a gap"},
      {"nan", with_lines(good, "0,nan"), 2, "gap [um]", "`nan` is not a number",
       "an empty field is a gap"},
      {"inf", with_lines(good, "0,-inf"), 2, "gap [um]", "`-inf` is not a number",
       "an empty field is a gap"},
      {"a unit in a field", with_lines(good, "0,1 um"), 2, "gap [um]",
       "`1 um` is not a number alone", "units stand in the header"},
      {"too large", with_lines(good, "0,1e300"), 2, "gap [um]", "too large", ""},
      {"hexadecimal", with_lines(good, "0,0x1p3"), 2, "gap [um]", "is not a number", ""},
      {"no time in a line", with_lines(good, ",1"), 2, "t", "is empty",
       "expected a time in every line"},
      {"ragged", with_lines(good, "0,1,2"), 2, "", "the line has 3 fields, but the header has 2",
       ""},
      {"decimal comma between commas", with_lines(good, "0,1,5"), 2, "",
       "the line has 3 fields, but the header has 2", ""},
      {"both marks", "t [s];gap [um]\n0,5;1.5\n", 2, "gap [um]", "decimal point", "one of the two"},
      {"time stands", with_lines(good, "1,1"), 3, "t",
       "is not later than the time of the line before", "ascend"},
      {"too few", "t [s],gap [um]\n0,1\n1,1\n", 0, "", "2 samples are too few", "16 or more"},
      {"UTF-16", std::string("\xFF\xFEt\0", 4), 0, "", "is UTF-16", "expected text in UTF-8"},
      {"binary", std::string("t [s]\0gap", 9), 0, "", "is not text", "expected text in UTF-8"},
  };
  for (const Refused& bad : all) {
    SCOPED_TRACE(bad.name);
    const auto refused = test::refusals([&] { parse_measured(bad.text, "rig.csv"); });
    ASSERT_FALSE(refused.empty());
    const scene::Diagnostic& first = refused.front();
    EXPECT_EQ(first.file, "rig.csv");
    EXPECT_EQ(first.line, bad.line);
    EXPECT_EQ(first.key, bad.key) << first.reason;
    EXPECT_TRUE(test::contains(first.reason, {bad.says, bad.accepts}));
  }
}

TEST(MeasuredReader, ToldAreAllFaultsButNoFlood) {
  std::string text = "t [s],gap [um]\n";
  for (int k = 0; k < 1000; ++k) text += std::to_string(k) + ",x\n";
  const auto refused = test::refusals([&] { parse_measured(text, "rig.csv"); });
  ASSERT_EQ(refused.size(), kMostFaults);
  EXPECT_EQ(refused[1].line, 3);
}

TEST(MeasuredReader, AColumnWithoutAnyValueIsRefused) {
  std::string text = "t [s],gap [um],force [N]\n";
  for (int k = 0; k < 20; ++k) text += std::to_string(k) + ",1,\n";
  EXPECT_THROW(parse_measured(text, "rig.csv"), scene::SceneError);
  EXPECT_THROW(read_measured("/no/such/file.csv"), scene::SceneError);
  EXPECT_THROW(read_measured("/tmp"), scene::SceneError);
}

}  // namespace
}  // namespace rotorub
