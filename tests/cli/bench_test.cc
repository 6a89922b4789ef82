// rotorub bench as a user starts it.
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using Files = std::vector<std::string>;

TEST(CliBench, PrintsJsonAndNothingElse) {
  const Folder folder;
  const json all =
      folder.json_of({"bench", shipped("bench_drop"), "--engines", "native-verlet,mujoco-rigid",
                      "--steps", "100us,50us", "--repeats", "2", "--json"});
  const json& scene = all.at("scenes").at(0);
  EXPECT_EQ(scene.at("scene"), "bench_drop");
  ASSERT_EQ(scene.at("points").size(), 6u) << "two steps; MuJoCo with two integrators";
  for (const json& p : scene["points"]) {
    EXPECT_EQ(p["outcome"], "ok");
    EXPECT_EQ(p["wall_ms"]["repeats"], 2);
    EXPECT_GT(p["position_error"].get<double>(), 0.0);
    EXPECT_LE(p["wall_ms"]["low"].get<double>(), p["wall_ms"]["median"].get<double>());
  }
  EXPECT_EQ(folder.files(), Files{}) << "nothing is written without -o";
}

TEST(CliBench, EachSceneHasItsTable) {
  const Folder folder;
  const Outcome done =
      folder.done({"bench", shipped("bench_drop"), shipped("bench_billiard"), "--engines", "native",
                   "--steps", "100us,50us,20us", "--tolerances", "1e-6,1e-9", "--repeats", "1"});
  EXPECT_TRUE(contains(done.out, {"bench_drop:", "bench_billiard:", "native-event", "closed form",
                                  "A native integrator is the fastest"}));
}

// The files appear complete, the page needs no network, and bench.json equals the output of --json.
TEST(CliBenchLong, WritesPageAndJson) {
  const Folder folder;
  const Outcome done =
      folder.done({"bench", shipped("bench_drop"), "--engines", "native,mujoco-cone", "--steps",
                   "100us,50us", "--repeats", "1", "-o", "deep/out"});
  EXPECT_EQ(folder.files(), (Files{"deep/out/bench.html", "deep/out/bench.json"}));
  const json all = folder.json_in("deep/out/bench.json");
  EXPECT_TRUE(all.contains("restitution"));
  EXPECT_TRUE(all["scenes"][0].contains("stability"));
  EXPECT_TRUE(folder.text("deep/out/bench.html").ends_with("</html>\n"));
}

// An integrator's own name, and names from earlier releases, which run `verlet`.
TEST(CliBench, TakesIntegratorsAsRunDoes) {
  const Folder folder;
  for (const std::string word : {"verlet", "paper", "midpoint"}) {
    const Outcome done = folder.done({"bench", shipped("bench_drop"), "--engines", word, "--steps",
                                      "100us", "--repeats", "1", "--set", "run.end=1e-3"});
    EXPECT_TRUE(contains(done.out, "native-verlet")) << done.out;
    EXPECT_EQ(contains(done.err, "note: "), word != "verlet") << done.err;
  }
}

TEST(CliBench, RefusesBadInputWithWhatIsAccepted) {
  const Folder folder;
  struct Case {
    std::vector<std::string> arguments;
    const char* said;
  };
  for (const Case& c :
       {Case{{"--engines", "bullet"}, "native-verlet"}, Case{{"--steps", "3 kg"}, "--steps"},
        Case{{"--steps", "10us,0"}, "above 0"}, Case{{"--tolerances", "2"}, "above 0 and below 1"},
        Case{{"--repeats", "0"}, "1 or more"}}) {
    folder.refuses(with({"bench", shipped("bench_drop")}, c.arguments), {c.said});
  }
  // All scenes are checked before the first is run.
  folder.refuses({"bench", shipped("bench_ring"), "nowhere.toml"}, {"nowhere.toml"});
  EXPECT_EQ(folder.files(), Files{});
}

}  // namespace
}  // namespace rotorub::test
