// The parts of a result that a page lays out.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "compare/result/result.h"

namespace rotorub::result {
namespace {

using nlohmann::json;

TEST(ResultPage, HasSentencesWithTheirToneAndHeadings) {
  const Section result{
      .parts = {line("\nat 10 Hz", Role::kHeading), Sentence{}, Data{"a", 1},
                Sentence{.text = "it <b>moves", .lead = "  note: "}, line("two\n  lines\n"),
                Sentence{.text = "is off", .lead = "  OUTSIDE ", .tone = Tone::kBad},
                Sentence{.text = "by 3 %", .lead = "    - "},
                Sentence{.text = "on the terminal", .seen = kNotPage}}};
  EXPECT_EQ(page_json(result), json::parse(R"([
    {"heading": "at 10 Hz"}, {"text": "note: it <b>moves"}, {"lines": "two\n  lines\n"},
    {"text": "OUTSIDE is off", "tone": "bad", "toned": "OUTSIDE"},
    {"text": "by 3 %", "mark": "-"}])"));
}

TEST(ResultPage, HasTheTextsOfATable) {
  const Table table{
      "list/#/{column}",
      {{"name", "figure", -9}, {"value", "N", 9}, {.key = "slip", .seen = kJson}, {.seen = kPage}},
      {{.items = {{"force"}, {1.5}, {2}, {.text = "bad", .tone = Tone::kBad, .note = "why"}},
        .note = {.text = "because", .lead = "      "}},
       {.items = {{"whirl"}, {nullptr}}, .lead = "* "},
       {.items = {{"none"}}, .seen = kNotPage}}};
  EXPECT_EQ(page_json({.parts = {line("  in short", Role::kCaption), table}}), json::parse(R"([
    {"caption": "in short",
     "columns": [{"text": "figure"}, {"text": "N", "number": true}, {"text": ""}],
     "rows": [{"cells": ["force", "1.500", {"text": "bad", "tone": "bad", "note": "why"}],
               "note": "because"},
              {"cells": ["whirl", "–", ""], "mark": "*"}]}])"));
  EXPECT_EQ(text_of({.parts = {table}}),
            "  figure         N\n  force      1.500\n      because\n* whirl          –\n  none\n");
}

TEST(ResultPage, HasWordsBesideAValue) {
  const Table table{
      .columns = {{.heading = "N", .width = 6}},
      .rows = {
          {.items = {{.text = "21.9", .tone = Tone::kBad, .note = "outside", .beside = "+3 %"}}}}};
  EXPECT_EQ(page_json({.parts = {table}})[0]["rows"][0]["cells"][0],
            json::parse(R"({"text": "21.9", "tone": "bad", "note": "outside", "beside": "+3 %"})"));
  EXPECT_EQ(text_of({.parts = {table}}, Palette(true)), "     N\n  21.9\n") << "without its tone";
}

TEST(ResultPage, HasHeadingsThatTheTerminalLeavesOut) {
  const Table table{.columns = {{.width = 5, .title = "Hz"}}, .rows = {{.items = {{2}}}}};
  EXPECT_EQ(text_of({.parts = {table}}), "    2\n");
  EXPECT_EQ(page_json({.parts = {table}})[0]["columns"][0]["text"], "Hz");
}

TEST(ResultPage, HasNoTableWithoutRows) {
  EXPECT_EQ(page_json({.parts = {Table{"list/#/{column}", {{"a", "A"}}}}}), json::array());
}

TEST(ResultPage, HasSectionsThatHaveATitle) {
  const std::vector<Part> parts{line("words")};
  EXPECT_EQ(
      page_json({.parts = {Section{"scenes/#", parts, kAll, "ring"},
                           Section{"scenes/#", parts, kAll, "drop"}, Section{"twin", parts},
                           Section{"json", parts, kJson}, Section{"empty", {}, kAll, "nothing"},
                           Section{"", parts, kAll, "all", "figures"}}}),
      json::parse(R"([{"id": "scenes-1", "title": "ring", "parts": [{"text": "words"}]},
                      {"id": "scenes-2", "title": "drop", "parts": [{"text": "words"}]},
                      {"text": "words"},
                      {"id": "figures", "title": "all", "parts": [{"text": "words"}]}])"));
}

}  // namespace
}  // namespace rotorub::result
