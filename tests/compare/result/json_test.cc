// Where the parts of a result stand in JSON.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/result/result.h"

namespace rotorub::result {
namespace {

using nlohmann::json;

const std::vector<Column> kColumns = {{.key = "engine"}, {.key = "error"}};

json json_of_table(Table table) { return json_of({.parts = {std::move(table)}}); }

TEST(ResultJson, HasDataAtItsPlaceOrAmongTheKeysOfTheSection) {
  EXPECT_EQ(json_of({.parts = {Data{"", {{"a", 1}, {"b", nullptr}}}, Data{"c/d", 2}}}),
            json::parse(R"({"a": 1, "b": null, "c": {"d": 2}})"));
  EXPECT_EQ(json_of({}), json::object());
}

TEST(ResultJson, HasOnlySentencesWithAPlace) {
  const Section result{.parts = {Sentence{.text = "for people"},
                                 Sentence{.text = "why", .place = "reason"},
                                 Sentence{.text = "one", .place = "remarks/#"},
                                 Sentence{.text = "two", .place = "remarks/#"},
                                 Sentence{.text = "no", .place = "no", .seen = kPeople}}};
  EXPECT_EQ(json_of(result), json::parse(R"({"reason": "why", "remarks": ["one", "two"]})"));
}

TEST(ResultJson, HasSectionsAsObjectsOrElementsOfAList) {
  const Section result{
      .parts = {Section{"twin", {Data{"time", 1}}}, Section{"empty"},
                Section{"speeds/#", {Data{"speed", 2}}}, Section{"speeds/#", {Data{"speed", 3}}},
                Section{"", {Data{"beside", 4}}}, Section{"people", {Data{"none", 5}}, kPeople}}};
  EXPECT_EQ(json_of(result), json::parse(R"({"twin": {"time": 1}, "empty": {}, "beside": 4,
                                             "speeds": [{"speed": 2}, {"speed": 3}]})"));
}

TEST(ResultJson, HasARowAsAnElementOfAList) {
  const Table table{"levels/#/{column}",
                    kColumns,
                    {{.items = {{"native"}, {0.5}}},
                     {.items = {{"mujoco"}, {nullptr}}},
                     {.items = {{"peer"}, {.text = "absent"}}}}};
  const json levels = json::parse(
      R"([{"engine": "native", "error": 0.5}, {"engine": "mujoco", "error": null},
          {"engine": "peer"}])");
  EXPECT_EQ(json_of_table(table), json({{"levels", levels}}));
  EXPECT_EQ(json_of({.parts = {table, table}})["levels"].size(), 6U);
}

TEST(ResultJson, HasARowAsAnObjectByItsKey) {
  const Table table{"figures/{row}/{column}",
                    kColumns,
                    {{.key = "force", .items = {{"n"}, {1}}}, {.items = {{"no key"}, {2}}}}};
  EXPECT_EQ(json_of_table(table),
            json::parse(R"({"figures": {"force": {"engine": "n", "error": 1}}})"));
}

TEST(ResultJson, HasTheValuesOfOneColumn) {
  const std::vector<Column> columns = {{.heading = "label"}, {.key = "value"}};
  const std::vector<Row> rows = {{.key = "a", .items = {{"first"}, {1}}},
                                 {.key = "b", .items = {{"second"}, {2}}}};
  EXPECT_EQ(json_of_table({"errors/{row}", columns, rows}),
            json::parse(R"({"errors": {"a": 1, "b": 2}})"));
  EXPECT_EQ(json_of_table({"{row}", columns, rows}), json::parse(R"({"a": 1, "b": 2})"));
  EXPECT_EQ(json_of_table({"speeds/#", columns, rows}), json::parse(R"({"speeds": [1, 2]})"));
}

TEST(ResultJson, HasPartsInAnElementOfAList) {
  const Section result{
      .parts = {Table{"loops/#/{column}", {{.key = "a"}}, {{.items = {{1}}}, {.items = {{2}}}}},
                Table{"loops/{row}/e/{column}", {{.key = "f"}}, {{.key = "0", .items = {{5}}}}},
                Data{"loops/1/b", 3}, Section{"loops/0/c", {Data{"d", 4}}}}};
  EXPECT_EQ(
      json_of(result),
      json::parse(R"({"loops": [{"a": 1, "c": {"d": 4}, "e": {"f": 5}}, {"a": 2, "b": 3}]})"));
}

TEST(ResultJson, HasOneEntryPerCell) {
  const std::vector<Column> columns = {{.heading = "figure"}, {.key = "cone"}, {.key = "rigid"}};
  const std::vector<Row> rows = {
      {.key = "force", .items = {{.text = "mean force"}, {{{"native", 1}}}, {{{"native", 2}}}}}};
  EXPECT_EQ(json_of_table({"differences/{column}/figures/{row}", columns, rows}),
            json::parse(R"({"differences": {"cone": {"figures": {"force": {"native": 1}}},
                                            "rigid": {"figures": {"force": {"native": 2}}}}})"));
  EXPECT_EQ(json_of_table({"{column}/impacts/#", columns, {rows[0], rows[0]}}),
            json::parse(R"({"cone": {"impacts": [{"native": 1}, {"native": 1}]},
                            "rigid": {"impacts": [{"native": 2}, {"native": 2}]}})"));
  EXPECT_EQ(json_of_table({"steps/{column}", columns, rows}),
            json::parse(R"({"steps": {"cone": {"native": 1}, "rigid": {"native": 2}}})"));
}

TEST(ResultJson, HasTheDataOfARowAmongItsCells) {
  const std::vector<Row> rows = {{.key = "x", .items = {{"n"}}, .data = {{"rms", 1}}},
                                 {.key = "y", .data = {{"rms", 2}}}};
  EXPECT_EQ(json_of_table({"list/#/{column}", kColumns, rows}),
            json::parse(R"({"list": [{"engine": "n", "rms": 1}, {"rms": 2}]})"));
  EXPECT_EQ(json_of_table({"by/{row}/{column}", kColumns, rows}),
            json::parse(R"({"by": {"x": {"engine": "n", "rms": 1}, "y": {"rms": 2}}})"));
}

TEST(ResultJson, HasTheCellsOfAColumnAtAPlace) {
  const Table table{"figures/{row}/{column}",
                    {{.key = "measured"}, {.key = "runs/cone"}},
                    {{.key = "force", .items = {{1}, {2}}}}};
  EXPECT_EQ(json_of_table(table),
            json::parse(R"({"figures": {"force": {"measured": 1, "runs": {"cone": 2}}}})"));
}

TEST(ResultJson, HasAnEmptyListOrObjectWithoutRows) {
  EXPECT_EQ(json_of_table({"levels/#/{column}", kColumns}), json::parse(R"({"levels": []})"));
  EXPECT_EQ(json_of_table({"figures/{row}/{column}", kColumns}), json::parse(R"({"figures": {}})"));
  EXPECT_EQ(json_of_table({"{column}/rows/{row}", kColumns}),
            json::parse(R"({"engine": {"rows": {}}, "error": {"rows": {}}})"));
}

TEST(ResultJson, LeavesOutWhatIsForPeople) {
  Table table{"list/#/{column}",
              {{.key = "a", .seen = kPeople}, {.key = "b"}},
              {{.items = {{1}, {2}}}, {.items = {{3}, {4}}, .seen = kPeople}}};
  EXPECT_EQ(json_of_table(table), json::parse(R"({"list": [{"b": 2}]})"));
  table.seen = kPeople;
  EXPECT_EQ(json_of_table(table), json::object());
  table.seen = kAll;
  table.place.clear();
  EXPECT_EQ(json_of_table(table), json::object());
}

TEST(ResultJson, SortsItsKeysUnlessTheyAreOrdered) {
  const Section result{
      .parts = {Data{"z", 1}, Data{"a", std::nan("")},
                Table{"list/#/{column}", {{.key = "y"}, {.key = "b"}}, {{.items = {{1}, {2}}}}}}};
  EXPECT_EQ(json_of(result).dump(), R"({"a":null,"list":[{"b":2,"y":1}],"z":1})");
  EXPECT_EQ(ordered_json_of(result).dump(), R"({"z":1,"a":null,"list":[{"y":1,"b":2}]})");
}

}  // namespace
}  // namespace rotorub::result
