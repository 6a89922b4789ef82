// The branches of `modes --periodic --across`, against the closed forms.
#include "compare/modes/rub_branches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "compare/modes/rub_branches_text.h"
#include "native_model/linear/rub_map.h"
#include "tests/native_model/periodic/bounce_once_a_turn.h"

namespace rotorub {
namespace {

using periodic::PointKind;

scene::Variants scenes_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return scene::Variants(std::string(ROTORUB_MJCF_DIR) + "/" + name + ".toml", overrides);
}

const MapAxis kFrictions{kFrictionKey, "", {0.1, 0.2, 0.26}};

std::vector<RubOnBranch> named(const RubBranch& branch, PointKind kind) {
  std::vector<RubOnBranch> found;
  std::ranges::copy_if(branch.points, std::back_inserter(found),
                       [kind](const RubOnBranch& at) { return at.point == kind; });
  return found;
}

// Design: the whip has a fold at a friction of 0.15510962 and loses its stability at 0.242109.
TEST(RubBranches, OfTheWhipHaveItsFoldAndItsTorus) {
  const RubBranches all = rub_branches(scenes_of("bench_whip"), kFrictions, {});
  ASSERT_EQ(all.branches.size(), 2u) << "the whip, and rolling from a friction of 0.26";
  EXPECT_EQ(all.branches[1].points.front().rub.kind, "rolling");
  const RubBranch& whip = all.branches[0];
  EXPECT_EQ(whip.from, 0.2);
  const auto folds = named(whip, PointKind::kFold), tori = named(whip, PointKind::kTorus);
  ASSERT_EQ(folds.size(), 1u);
  EXPECT_NEAR(folds[0].value, 0.15510962126429, 1e-8);
  ASSERT_EQ(tori.size(), 1u);
  EXPECT_NEAR(tori[0].value, 0.242109, 1e-6);
  for (const RubOnBranch& at : whip.points) EXPECT_EQ(at.rub.kind, "backward whip") << at.value;
  EXPECT_FALSE(whip.points.front().rub.settled.motion.stable) << "beyond the fold";
  EXPECT_FALSE(whip.points.back().rub.settled.motion.stable) << "beyond the torus";
  EXPECT_EQ(whip.last_end, "the parameter leaves its range");
}

// The load begins late, and each diagram begins its periods after that.
TEST(RubBranches, AgreeWithTheClosedFormsAtSeveralSpeeds) {
  const std::vector<std::string> late{"force[0].on=0.05"};
  const scene::Variants scenes = scenes_of("bench_annular_elastic", late);
  const MapAxis frictions{kFrictionKey, "", {0.02, 0.4}};
  const MapAxis speeds{kSpeedKey, "rad/s", {290.0, 330.0}};
  const RubBranches all = rub_branches(scenes, frictions, speeds);
  scene::Scene scene = scenes.scene({}, false);
  scene.forces[0].on = 0.0;
  scene.initial = {};
  const rub::RubSystem system = rub::rub_system(scene);
  for (const double speed : speeds.values) {
    const rub::RubStudy study(rub::at_speed(system, speed));
    std::size_t compared = 0;
    for (const RubBranch& branch : all.branches) {
      if (branch.up != speed) continue;
      for (const RubOnBranch& at : branch.points) {
        if (at.rub.kind != "synchronous rub" || at.point != PointKind::kRegular) continue;
        const rub::RubPoint point = study.at(FrictionLaw{at.value});
        const rub::StandingRub* forced = point.leading(rub::RubKind::kForced);
        ASSERT_NE(forced, nullptr) << speed << ", " << at.value;
        const double force = at.rub.figures[0].mean_force;
        EXPECT_NEAR(force, forced->rub.normal_force, 1e-8 * force) << speed << ", " << at.value;
        EXPECT_EQ(at.rub.settled.motion.stable, forced->stability.stable) << at.value;
        ++compared;
      }
    }
    EXPECT_GT(compared, 15u) << speed;
  }
}

// Beyond its period doubling the bounce repeats after two turns (bounce_once_a_turn.h). A run
// settles on that branch, which begins at the doubling.
TEST(RubBranches, OfABounceGoOnBeyondItsPeriodDoubling) {
  const test::BounceOnceATurn bounce;
  const SceneAt scene_at = [&](double swing, double) {
    scene::Scene scene = bounce.scene();
    scene.forces[1].amplitude = scene.forces[2].amplitude = 0.5 * swing;
    scene.rotor.modal->damping = {0.5};
    return scene;
  };
  const MapAxis swings{"force[1].amplitude", "N", {13.0, 1.05 * bounce.doubling_swing()}};
  const RubBranches all = rub_branches(scene_at, swings, {});
  const auto begins = [](const RubBranch& branch) { return branch.origin.has_value(); };
  const auto two = std::ranges::find_if(all.branches, begins);
  ASSERT_NE(two, all.branches.end());
  EXPECT_EQ(std::ranges::count_if(all.branches, begins), 1) << "it is followed once";
  EXPECT_EQ(two->points.front().rub.settled.order, 2);
  EXPECT_NE(std::ranges::find(two->starts, "the scene's start"), two->starts.end());
  const RubBranch& once = all.branches[two->origin->branch];
  EXPECT_EQ(once.points.front().rub.settled.order, 1);
  const auto doublings = named(once, PointKind::kPeriodDoubling);
  ASSERT_EQ(doublings.size(), 1u);
  EXPECT_EQ(two->origin->value, doublings[0].value);
  EXPECT_NEAR(doublings[0].value, bounce.doubling_swing(), 0.1) << "with a little damping";
  for (const RubOnBranch& at : two->points) {
    EXPECT_GE(at.value, doublings[0].value - 1e-9);
    EXPECT_EQ(at.rub.passes.size(), 2u) << at.value;
  }
  const result::Section section = rub_branches_result("bounce", all);
  const nlohmann::json printed = result::json_of(section).at("rub_branches").at("branches");
  const nlohmann::json& origin =
      printed.at(static_cast<std::size_t>(two - all.branches.begin())).at("origin");
  EXPECT_EQ(origin.at("branch"), two->origin->branch + 1);
  EXPECT_EQ(origin.at("value"), two->origin->value);
  EXPECT_NE(result::text_of(section).find("from the period doubling of branch"), std::string::npos);
}

TEST(RubBranches, StandInJsonInTheTableAndInWords) {
  const RubBranches all = rub_branches(scenes_of("bench_whip"), kFrictions, {});
  const result::Section section = rub_branches_result("bench_whip", all);
  const nlohmann::json printed = result::json_of(section).at("rub_branches");
  EXPECT_EQ(printed.at("across").at("key"), "contact.friction");
  EXPECT_TRUE(printed.at("up").is_null());
  const nlohmann::json& branch = printed.at("branches").at(0);
  EXPECT_EQ(branch.at("points").size(), all.branches[0].points.size());
  EXPECT_FALSE(printed.at("without").empty()) << "at 0.1 a run settles to no rub";
  const std::string words = result::text_of(section);
  for (const char* word : {"fold", "torus", "unstable", "0.1551096"})
    EXPECT_NE(words.find(word), std::string::npos) << word << "\n" << words;
  std::istringstream table(rub_branches_csv(all));
  std::string line;
  std::getline(table, line);
  EXPECT_TRUE(line.starts_with("branch,contact.friction,point,kind,stable,multiplier,")) << line;
  const auto columns = std::ranges::count(line, ',');
  std::size_t lines = 0;
  for (; std::getline(table, line); ++lines) EXPECT_EQ(std::ranges::count(line, ','), columns);
  EXPECT_EQ(lines, all.branches[0].points.size() + all.branches[1].points.size());
}

}  // namespace
}  // namespace rotorub
