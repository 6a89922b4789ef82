// A result as text on a terminal.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "compare/result/result.h"

namespace rotorub::result {
namespace {

const Palette kColours(true);

std::string text_of_part(Part part, const Palette& palette = Palette()) {
  return text_of({.parts = {std::move(part)}}, palette);
}

TEST(ResultText, WrapsSentencesBehindTheirLead) {
  const std::string words = "one two three four five six seven eight nine ten eleven twelve 13 14";
  EXPECT_EQ(text_of_part(Sentence{.text = words, .lead = "  warning: "}),
            "  warning: one two three four five six seven eight nine ten eleven twelve 13 14\n");
  EXPECT_EQ(text_of_part(Sentence{.text = words + " 15", .lead = "  warning: "}),
            "  warning: one two three four five six seven eight nine ten eleven twelve 13 14\n"
            "           15\n");
  EXPECT_EQ(text_of_part(Sentence{.text = words + " 15", .lead = "  warning: ", .indent = 2}),
            "  warning: one two three four five six seven eight nine ten eleven twelve 13 14\n"
            "  15\n");
  EXPECT_EQ(text_of_part(Sentence{}), "\n");
}

TEST(ResultText, KeepsALineAsItIs) {
  const std::string path(100, 'a');
  EXPECT_EQ(text_of_part(line("written  to " + path)), "written  to " + path + "\n");
  EXPECT_EQ(text_of_part(line("two\nlines\n")), "two\nlines\n");
}

TEST(ResultText, AlignsTheItemsOfATable) {
  const Table table{"",
                    {{.heading = "figure", .width = -12},
                     {.heading = "native", .width = 8},
                     {.heading = "note", .width = -8}},
                    {{.items = {{"force"}, {1.25}, {"  good"}}, .lead = "* "},
                     {.items = {{"whirl, µm"}, {{}, "∞"}}},
                     {.items = {{"a long name"}, {2}, {}}}}};
  EXPECT_EQ(text_of_part(table),
            "  figure      native"
            "note\n"
            "* force        1.250  good\n"
            "  whirl, µm        ∞\n"
            "  a long name       2\n");
}

TEST(ResultText, HasNoHeadingLineWithoutHeadings) {
  EXPECT_EQ(text_of_part(Table{"", {{.width = -6}, {.width = 4}}, {{.items = {{"a"}, {1}}}}, ""}),
            "a        1\n");
}

TEST(ResultText, WritesValuesThatHaveNoText) {
  const Table table{"",
                    {{.width = 9}},
                    {{.items = {{21.8567}}},
                     {.items = {{1e-9}}},
                     {.items = {{nullptr}}},
                     {.items = {{std::nan("")}}},
                     {.items = {{true}}},
                     {.items = {{7}}},
                     {.items = {{0.5, "half"}}},
                     {.items = {{}}}},
                    ""};
  EXPECT_EQ(text_of_part(table),
            "    21.86\n 1.00e-09\n        –\n        –\n      yes\n        7\n     half\n\n");
}

TEST(ResultText, HasANoteBelowARow) {
  const Table table{
      "",
      {{.width = 0}},
      {{.items = {{"yes"}}, .note = {.text = "because", .lead = "      "}}, {.items = {{"no"}}}}};
  EXPECT_EQ(text_of_part(table), "  yes\n      because\n  no\n");
}

TEST(ResultText, LeavesOutWhatIsForJson) {
  const Section result{
      .parts = {Data{"a", 1}, Sentence{.text = "s", .seen = kJson},
                Table{"list/#/{column}",
                      {{.key = "a", .heading = "A", .width = 3, .seen = kJson},
                       {.key = "b", .heading = "B", .width = 3}},
                      {{.items = {{1}, {2}}}, {.items = {{3}, {4}}, .seen = kJson}}},
                Section{"c", {line("no")}, kJson}, Section{"d", {line("end")}}}};
  EXPECT_EQ(text_of(result), "  B\n  2\nend\n");
}

TEST(ResultText, PaintsTheWordsThatHaveATone) {
  EXPECT_EQ(text_of_part(Sentence{.text = "it is off", .lead = "  OUTSIDE ", .tone = Tone::kBad},
                         kColours),
            "\033[1;31m  OUTSIDE \033[0mit is off\n");
  EXPECT_EQ(text_of_part(Sentence{.text = "run: ok", .tone = Tone::kGood, .toned = "ok"}, kColours),
            "run: \033[1;32mok\033[0m\n");
  EXPECT_EQ(
      text_of_part(Table{"", {{.width = 6}}, {{.items = {{"no", "", Tone::kPart}}}}}, kColours),
      "    \033[1;33mno\033[0m\n");
}

TEST(ResultPrint, IsJsonOrTextOrNothing) {
  Section result{.parts = {Data{"a", 1}}};
  result.add({line("text")});
  const auto printed = [&](const Printing& how) {
    testing::internal::CaptureStdout();
    print(result, how);
    return testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(printed({}), "text\n");
  EXPECT_EQ(printed({.json = true}), "{\n  \"a\": 1\n}\n");
  EXPECT_EQ(printed({.json = true, .quiet = true}), "{\n  \"a\": 1\n}\n");
  EXPECT_EQ(printed({.quiet = true}), "");
}

// Units of sentences, of the labels of rows and of the headings of columns.
TEST(ResultText, UnitsAreChosenForEveryTable) {
  const auto of = [](Part part, Units units) {
    return text_of({.parts = {std::move(part)}}, Palette(), units);
  };
  const Sentence gap{.text = "The gap is 10 µm at 100 N (10 kg m^2, 3 modes)."};
  EXPECT_EQ(of(gap, Units::kUs), "The gap is 0.3937 mil at 22.48 lbf (10 kg m^2, 3 modes).\n");
  EXPECT_EQ(of(gap, Units::kMm), "The gap is 0.01000 mm at 100 N (10 kg m^2, 3 modes).\n");
  EXPECT_EQ(of(gap, Units::kAsWritten), gap.text + "\n");
  const Table rows{.columns = {{"", "", -20}, {"", "", 6}},
                   .rows = {{.items = {{"impulse, N s"}, {2.0}}}, {.items = {{"steps"}, {7}}}}};
  EXPECT_EQ(of(rows, Units::kUs), "  impulse, lbf s    0.4496\n  steps                  7\n");
  const Table columns{.columns = {{"", "station", -9}, {"z", "z / mm", 8}},
                      .rows = {{.items = {{"disc"}, {100.0}}}}};
  EXPECT_EQ(of(columns, Units::kUs), "  station  z / in\n  disc      3.937\n");
  EXPECT_EQ(of(columns, Units::kSi), "  station   z / m\n  disc     0.1000\n");
}

}  // namespace
}  // namespace rotorub::result
