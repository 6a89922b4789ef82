#include "compare/report/beside.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "compare/bench/output.h"
#include "compare/report/page.h"
#include "native_model/scene/reader.h"
#include "tests/compare/bench/made_points.h"
#include "tests/compare/hand_made.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

using nlohmann::json;

class BesideFolder : public testing::Test {
 protected:
  Beside read() const { return read_beside({top.path().string()}); }
  std::string refusal() const {
    return test::message_of([&] { read(); });
  }
  const test::TemporaryFolder top;
};

json kept_bench() {
  bench::SceneBench b;
  b.scene = scene::read_scene(std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml");
  b.reference.source = "made up";
  b.reference.trajectory =
      test::hand_made(101, 1e-3, [](double t) { return test::sliding({}, t); });
  b.engines = {test::made_engine("native-event", bench::Family::kNative),
               test::made_engine("mujoco-rigid", bench::Family::kMujoco)};
  b.points = {test::made_point("native-event", std::nullopt, 1e-7, 2e-3, "tolerance 1e-6"),
              test::made_point("native-event", std::nullopt, 1e-9, 3e-3, "tolerance 1e-8"),
              test::made_point("mujoco-rigid", 1e-4, 7e-7, 6e-3, "Euler"),
              test::failed_point("mujoco-rigid", 1e-3, bench::Outcome::kDiverged, "it flew away")};
  b.points[3].setting.setting = "Euler";
  return json_of(bench::result_of({"made-up processor", 2, "avx2", "g++ 12", "2.2.2"}, {b}, {}));
}

const char* const kMap =
    R"({"name": "ring", "answer": ["No contact everywhere."], "plots": {
  "kind": "grid", "keys": [{"name": "k", "unit": "", "even": true, "log": false, "values": [1, 2]}],
  "figures": [{"name": "f", "unit": "N", "meaning": "m", "word": false}],
  "columns": [[3, 4]], "status": [0, 0], "statuses": ["ok"], "every": 1}})";

// The subfolders in order of name, one section each.
TEST_F(BesideFolder, FindsWhatTheCommandsLeft) {
  top.write("a/bench.json", kept_bench().dump());
  top.write("b/check.json", R"({"cases": [
    {"scene": "one", "engine": "native-event", "outcome": "pass", "rule": "", "value": null, "limit": null, "reason": ""},
    {"scene": "one", "engine": "mujoco-cone", "outcome": "violates", "rule": "", "value": 2, "limit": 1, "reason": "2 > 1"},
    {"scene": "two", "engine": "native-event", "outcome": "refused", "rule": "", "value": null, "limit": null, "reason": "no"}]})");
  top.write("c/sweep.json", kMap);
  top.write("d/series.csv", "t");
  const Beside beside = read();
  ASSERT_EQ(beside.benches.size(), 1u);
  json bench = beside.benches[0];
  EXPECT_EQ(bench.at("machine"), "made-up processor, avx2");
  bench.erase("machine");
  EXPECT_EQ(bench, kept_bench().at("scenes")[0]);

  const json& cases = beside.cases;
  const json& table = cases.at(1);
  ASSERT_EQ(table.at("rows").size(), 2u);
  const json& one = table["rows"][0]["cells"];
  EXPECT_EQ(one[0], "one");
  EXPECT_EQ(one[1], json({{"text", "pass"}, {"tone", "good"}}));
  const auto cone = std::ranges::find(table["columns"], "mujoco-cone",
                                      [](const json& column) { return column.at("text"); });
  const std::size_t column = static_cast<std::size_t>(cone - table["columns"].begin());
  EXPECT_EQ(one.at(column), json({{"text", "fails"}, {"tone", "bad"}, {"note", "2 > 1"}}));
  EXPECT_EQ(table["rows"][1]["cells"][1]["text"], "refused");
  EXPECT_EQ(table["rows"][1]["cells"].at(column), "") << "not run";
  EXPECT_EQ(cases.at(2).at("heading"), "fails:");
  EXPECT_EQ(cases.at(3).at("text"), "one, mujoco-cone: 2 > 1");
  ASSERT_EQ(beside.sweeps.size(), 1u);
  EXPECT_EQ(beside.sweeps[0], json::parse(kMap));
}

TEST_F(BesideFolder, RefusesOtherFolders) {
  EXPECT_NE(refusal().find("no bench.json, check.json or sweep.json"), std::string::npos);
  top.write("x/bench.json", "{");
  EXPECT_NE(refusal().find("x/bench.json"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find("rotorub bench -o DIR"), std::string::npos) << refusal();
  top.write("x/bench.json",
            R"({"machine": {"processor": "p", "instructions": "i"}, "scenes": [{"scene": 1}]})");
  EXPECT_NE(refusal().find("x/bench.json"), std::string::npos) << refusal();
  std::filesystem::remove(top / "x/bench.json");
  top.write("x/check.json", R"({"cases": [{"scene": "s", "engine": "other", "outcome": "pass",
                                           "reason": ""}]})");
  EXPECT_NE(refusal().find("no engine is called other"), std::string::npos) << refusal();
  std::filesystem::remove(top / "x/check.json");
  // A list that is shorter than the others would be drawn at wrong points.
  std::string cut = kMap;
  cut.replace(cut.find("[3, 4]"), 6, "[3]");
  top.write("x/sweep.json", cut);
  EXPECT_NE(refusal().find("x/sweep.json"), std::string::npos) << refusal();
  std::string wide = kMap;
  wide.replace(wide.find("[1, 2]"), 6, "[1, 2, 3]");
  top.write("x/sweep.json", wide);
  EXPECT_NE(refusal().find("a grid of 3 cells has 2 points"), std::string::npos) << refusal();
  std::string linear = kMap;
  linear.replace(linear.find("\"every\""), 7, R"("linear": {"rub_force": [1]}, "every")");
  top.write("x/sweep.json", linear);
  EXPECT_NE(refusal().find("a list of linear has not 2 values"), std::string::npos) << refusal();
  top.write("x/sweep.json", kMap);
  EXPECT_EQ(refusal(), "");
}

TEST_F(BesideFolder, IsInTheDataOfTheReport) {
  top.write("sweep.json", kMap);
  EXPECT_NE(report_page({}, read()).find(R"("sweeps":[{"answer":["No contact everywhere."])"),
            std::string::npos);
  EXPECT_NE(report_page({}).find(R"("benches":[],"cases":[])"), std::string::npos);
}

}  // namespace
}  // namespace rotorub
