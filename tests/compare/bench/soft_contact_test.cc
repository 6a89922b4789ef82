#include "compare/bench/soft_contact.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <utility>

#include "mjcf/soft_contact.h"
#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"

namespace rotorub::bench {
namespace {

const Progress kQuiet = [](double, const std::string&) {};

// A public benchmark of engines says that MuJoCo's restitution cannot be set. The direct solref
// sets it; the default does not.
TEST(RestitutionLong, MujocoCanBeCalibrated) {
  // Relative to the approach speed, for a bounce of 300 steps of which the last is complete.
  constexpr double kCalibrated = 3e-3;
  const auto rows = restitution_table(kQuiet, nullptr);
  int calibrated = 0, defaults = 0;
  for (const RestitutionRow& r : rows) {
    ASSERT_EQ(r.failure, "") << r.engine;
    if (r.setting == "K 1e6") {
      // No damping gives 0: see kMaxDampingRatio.
      const double least = soft_restitution(kMaxDampingRatio);
      EXPECT_NEAR(r.got, std::max(r.asked, least), kCalibrated) << r.engine << " " << r.asked;
      ++calibrated;
    } else if (r.setting == "default solref") {
      EXPECT_NEAR(r.got, std::exp(-2.0), kCalibrated) << "whatever is asked, as " << r.asked;
      ++defaults;
    } else if (r.engine == "mujoco-rigid" || r.engine == "native-verlet") {
      EXPECT_NEAR(r.got, r.asked, 1e-12) << r.engine;
    }
  }
  EXPECT_EQ(calibrated, 22);
  EXPECT_EQ(defaults, 11);
}

TEST(StabilityMapLong, HasACellForEveryStepStiffnessAndFriction) {
  const std::string file = std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml";
  const SceneReader reader = [&](const std::vector<std::string>& further) {
    std::vector<std::string> all{"run.end=0.1"};
    all.insert(all.end(), further.begin(), further.end());
    return scene::read_scene(file, all);
  };
  const StabilityMap map = stability_map(reader, reader({}), kQuiet, nullptr);
  ASSERT_EQ(map.frictions.size(), 3u);
  EXPECT_EQ(map.cells.size(), 3u * map.steps.size() * (1 + 3 * map.stiffnesses.size()));
  int cone_fine = 0;
  for (const StabilityCell& c : map.cells) {
    EXPECT_EQ(c.judgement.outcome == Outcome::kOk, c.judgement.reason.empty());
    if (c.engine == "mujoco-rigid") {
      EXPECT_EQ(c.judgement.outcome, Outcome::kOk) << c.step << " " << c.judgement.reason;
    }
    cone_fine += c.engine == "mujoco-cone" && c.judgement.outcome == Outcome::kOk ? 1 : 0;
  }
  EXPECT_EQ(cone_fine, 0) << "a rub that lasts bounces with the friction cone";
}

// The run is interrupted before its first cell.
TEST(StabilityMap, IsOfTheLargestFrictionInAnyOrder) {
  const std::atomic<bool> stop{true};
  scene::Scene scene = test::make_scene({.stiffness = 2e5, .friction = 0.1});
  scene.auxiliary.push_back(scene.first());
  scene.auxiliary[1].contact->friction = 0.3;
  for (const char* order : {"smooth ring first", "rough ring first"}) {
    SCOPED_TRACE(order);
    const SceneReader reader = [&](const std::vector<std::string>&) { return scene; };
    const StabilityMap map = stability_map(reader, scene, kQuiet, &stop);
    EXPECT_EQ(map.frictions, (std::vector<double>{0.5 * 0.3, 0.3, 2.0 * 0.3}));
    std::swap(scene.auxiliary[0], scene.auxiliary[1]);
  }
}

}  // namespace
}  // namespace rotorub::bench
