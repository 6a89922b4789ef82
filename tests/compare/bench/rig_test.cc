// The reference rig on the bench: a coarse rerun of what the table of compare/docs/findings.md says
// of it, and the peers that cannot hold it.
#include <gtest/gtest.h>

#include "compare/bench/scene_bench.h"
#include "native_model/scene/reader.h"

namespace rotorub::bench {
namespace {

SceneBench coarse_bench(const std::string& scene, const std::string& engines) {
  const std::string file = std::string(ROTORUB_MJCF_DIR) + "/" + scene + ".toml";
  BenchParameters parameters;
  parameters.ladder = {{1e-4, 2e-5, 1e-5}, {1e-4, 1e-5, 1e-6, 1e-7}};
  parameters.timing.repeats = 3;
  parameters.engines = chosen_engines(engines);
  return bench_scene(
      [&](const std::vector<std::string>& further) { return scene::read_scene(file, further); },
      parameters, [](double, const std::string&) {}, nullptr);
}

TEST(Rig, EventIsFastestDownToEngineeringErrors) {
  const SceneBench bench = coarse_bench("bench_rig", "native,mujoco-rigid,penalty");
  EXPECT_LT(bench.reference.error, 1e-13) << "m, by looser tolerances: no chaos up to the end";
  EXPECT_TRUE(bench.reference.trajectory.column("normal_force").back() > 0.0) << "rubs for good";
  for (const Level& level : bench.levels) {
    if (!in_headline(level)) continue;
    ASSERT_FALSE(level.engines.empty()) << level.share;
    EXPECT_TRUE(*native_is_fastest(level)) << level.share;
  }
  for (const Point& p : bench.points) {
    if (p.setting.engine != "penalty") continue;
    EXPECT_EQ(p.judgement.outcome, Outcome::kRefused);
    EXPECT_NE(p.judgement.reason.find("8 bending modes"), std::string::npos) << p.judgement.reason;
  }
}

// The bound of the law's step pays: at 1e-4 of the clearance its fastest setting is not the first,
// soft one.
TEST(Penalty, IsQuickerAtItsStepBound) {
  const SceneBench bench = coarse_bench("bench_annular_rigid", "native-event,penalty");
  const Level& level = bench.levels[2];
  ASSERT_EQ(level.engines.size(), 2u);
  EXPECT_NE(bench.points[level.engines[1].point].setting.setting, "RK4, sqrt(k/m)h 0.1");
  EXPECT_EQ(level.engines[0].engine, "native-event");
}

}  // namespace
}  // namespace rotorub::bench
