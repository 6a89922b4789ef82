// The outputs of a bench: JSON, terminal table, page.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/bench/output.h"
#include "compare/report/page.h"
#include "tests/compare/bench/made_points.h"
#include "tests/compare/hand_made.h"
#include "tests/support/native_run.h"
#include "tests/support/page.h"

namespace rotorub::bench {
namespace {

using nlohmann::json;
using test::failed_point;
using test::made_engine;
using test::made_point;

SceneBench made_bench() {
  SceneBench b;
  b.scene = test::shipped("bench_ring");
  b.reference.source = "made up";
  b.reference.trajectory =
      test::hand_made(1001, 1e-3, [](double t) { return test::sliding({}, t); });
  b.reference.times = b.reference.trajectory.column("t");
  b.reference.error = 1e-15;
  b.engines = {made_engine("native-verlet", Family::kNative),
               made_engine("mujoco-rigid", Family::kMujoco), made_engine("ode", Family::kPeer)};
  b.points = {made_point("native-verlet", 1e-4, 7e-7, 1e-3),
              made_point("native-verlet", 1e-5, 7e-9, 1e-2),
              made_point("native-verlet", 1e-6, 7e-11, 1e-1),
              made_point("mujoco-rigid", 1e-4, 7e-7, 6e-3, "Euler"),
              failed_point("ode", 1e-4, Outcome::kDiverged, "it <flew> away")};
  b.points[3].limit_error = 3e-7;
  b.levels = levels(b.points, b.engines, b.scene.first().contact->clearance, b.reference.error);
  StabilityMap map;
  map.engines = {"mujoco-cone"};
  map.steps = {1e-4, 1e-5};
  map.stiffnesses = {1e6};
  map.frictions = {0.15};
  map.cells = {{"mujoco-cone", 0.15, 1e-4, 1e6, {Outcome::kChatter, "it bounces"}},
               {"mujoco-cone", 0.15, 1e-5, 1e6, {}}};
  b.stability = map;
  return b;
}

const Machine kMachine{"made-up processor", 2, "avx2", "g++ 12", "2.2.2"};
const std::vector<RestitutionRow> kRestitution{{0.5, "mujoco-coulomb", "K 1e6", 0.4987, ""},
                                               {0.5, "ode", "", 0.0, "no impact"}};

// The contract's keys, with the types it promises.
TEST(BenchJson, HasTheKeysOfTheContract) {
  const json all = json_of(result_of(kMachine, {made_bench()}, kRestitution));
  EXPECT_TRUE(all.at("machine").is_object());
  ASSERT_EQ(all.at("scenes").size(), 1u);
  const json& scene = all["scenes"][0];
  EXPECT_EQ(scene.at("scene"), "bench_ring");
  EXPECT_TRUE(scene.contains("reference"));
  ASSERT_EQ(scene.at("points").size(), 5u);
  for (const json& p : scene["points"]) {
    for (const char* key : {"engine", "setting", "step", "outcome", "reason", "position_error",
                            "force_error", "penetration", "energy_residual", "steps", "us_per_step",
                            "real_time_factor", "wall_ms"}) {
      EXPECT_TRUE(p.contains(key)) << key;
    }
  }
  const json& first = scene["points"][0];
  EXPECT_EQ(first["engine"], "native-verlet");
  EXPECT_EQ(first["step"], 1e-4);
  EXPECT_EQ(first["outcome"], "ok");
  EXPECT_EQ(first["position_error"], 7e-7);
  EXPECT_NEAR(first["wall_ms"]["median"].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(first["wall_ms"]["low"].get<double>(), 0.9, 1e-12);
  EXPECT_NEAR(first["wall_ms"]["high"].get<double>(), 1.5, 1e-12);
  EXPECT_EQ(first["wall_ms"]["repeats"], 20);
  EXPECT_NEAR(first["us_per_step"].get<double>(), 10.0, 1e-9);
  const json& failed = scene["points"][4];
  EXPECT_EQ(failed["outcome"], "diverged");
  EXPECT_EQ(failed["reason"], "it <flew> away");
  EXPECT_TRUE(failed["position_error"].is_null());
  EXPECT_TRUE(failed["wall_ms"].is_null());
}

TEST(BenchJson, TheClearanceIsTheSmallestInAnyOrder) {
  SceneBench b = made_bench();
  b.scene.auxiliary.push_back(b.scene.first());
  const double smallest = 0.25 * b.scene.first().contact->clearance;
  b.scene.auxiliary[1].contact->clearance = smallest;
  for (const char* order : {"wide ring first", "narrow ring first"}) {
    SCOPED_TRACE(order);
    const json all = json_of(result_of(kMachine, {b}, {}));
    EXPECT_EQ(all.at("scenes")[0].at("clearance"), smallest);
    EXPECT_EQ(b.telling_errors().ceiling, smallest);
    std::swap(b.scene.auxiliary[0], b.scene.auxiliary[1]);
  }
}

TEST(BenchJson, LevelsOrdersMapAndRestitution) {
  const json all = json_of(result_of(kMachine, {made_bench()}, kRestitution));
  const json& scene = all["scenes"][0];
  const json& level = scene.at("levels")[1];
  EXPECT_EQ(level["native_is_fastest"], true);
  EXPECT_EQ(level["engines"][0]["engine"], "native-verlet");
  EXPECT_EQ(level["engines"][0]["step"], 1e-5);
  EXPECT_TRUE(scene["levels"][6]["native_is_fastest"].is_null()) << "nobody reaches 1e-8";
  EXPECT_NEAR(scene.at("series")[0]["order"].get<double>(), 2.0, 1e-9);
  EXPECT_TRUE(scene["series"][1]["order"].is_null());
  EXPECT_EQ(scene.at("stability").at("cells")[0]["outcome"], "chatter");
  EXPECT_EQ(all.at("restitution")[0]["got"], 0.4987);
  EXPECT_TRUE(all["restitution"][1]["got"].is_null());
  EXPECT_FALSE(json_of(result_of(kMachine, {}, {})).contains("restitution"));
}

// Never NaN, whatever a metric came to.
TEST(BenchJson, NumbersThatAreNotFiniteAreNull) {
  SceneBench b = made_bench();
  b.points[4].errors = PointErrors{std::numeric_limits<double>::quiet_NaN(), {}, {}};
  b.points[4].limit_error = std::numeric_limits<double>::infinity();
  const json point = json_of(scene_section(b)).at("points")[4];
  EXPECT_TRUE(point["position_error"].is_null());
  EXPECT_TRUE(point["limit_error"].is_null());
}

TEST(BenchTable, SaysWhoIsFastestAndWhatFailed) {
  const std::string text = text_of(scene_section(made_bench()));
  for (const char* part :
       {"bench_ring", "native-verlet", "mujoco-rigid ×6", "2.00", "1 diverged", "it <flew> away",
        "A native integrator is the fastest at every level that any engine"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  EXPECT_NE(text.find("\n  1e-05"), std::string::npos) << text;
  EXPECT_EQ(text.find("\n  1e-06"), std::string::npos) << "finer levels stand in the JSON";
}

// The longest name pushes nothing aside.
TEST(BenchTable, KeepsItsColumns) {
  SceneBench b = made_bench();
  b.engines.push_back(made_engine("mujoco-cone-coulomb", Family::kMujoco));
  b.points.push_back(made_point("mujoco-cone-coulomb", 1e-4, 4e-6, 1e-4, "Euler"));
  b.levels = levels(b.points, b.engines, b.scene.first().contact->clearance, 0.0);
  const std::string text = text_of(scene_section(b));
  const auto column = [&](const std::string& line, const char* word) {
    const std::size_t at = text.find(word, text.find(line));
    return at - text.rfind('\n', at);
  };
  EXPECT_NE(text.find("order –: An order needs at least three steps"), std::string::npos) << text;
  EXPECT_EQ(column("\n  1e-02", "Euler"), column("level", "setting")) << text;
  EXPECT_EQ(column("\n  1e-03", "10 µs"), column("level", "setting")) << text;
  EXPECT_EQ(column("\n  mujoco-cone-coulomb", "Euler"), column("\n  mujoco-rigid", "Euler"))
      << text;
}

TEST(BenchPage, IsSelfContainedAndEscaped) {
  const std::string page = page_of(
      "bench", "made", result_of(kMachine, {made_bench()}, kRestitution), {{"texts", {"scene"}}});
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  for (const char* part :
       {"\"kind\":\"bench\"", "it \\u003cflew> away", "it &lt;flew&gt; away", "made-up processor",
        "bouncing", "friction 0.1500", "0.4987", "no impact", "K 1e6", "Who is who"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  const std::string own = test::expect_self_contained(page);
  for (const char* part : {"it <flew> away", "NaN"})
    EXPECT_EQ(own.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace rotorub::bench
