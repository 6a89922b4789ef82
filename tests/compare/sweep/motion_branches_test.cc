// The branches of periodic motions under a bifurcation diagram.
#include "compare/sweep/motion_branches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/sweep/bifurcation.h"
#include "compare/sweep/page_data.h"
#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

using Phasor = std::complex<double>;

std::string speeds(const std::string& values) {
  return R"(scene = "free.toml"
[sample]
kind = "list"
[[vary]]
key = "rotor.speed"
values = )" +
         values + R"(
[run]
integrator = "event"
)";
}

TEST(MotionBranches, OfAFreeRotorAreItsUnbalanceVector) {
  test::StudyFolder folder;
  folder.write("free.toml", test::kFreeRotor);
  const Study study = folder.study(speeds("[185.0, 200.0, 215.0]"));
  const PointScenes scenes(study, {});
  const MotionBranches all = motion_branches(scenes, nullptr, {});
  ASSERT_EQ(all.refused, "");
  ASSERT_EQ(all.found.branches.size(), 1u);
  const RubBranch& branch = all.found.branches[0];
  ASSERT_GT(branch.points.size(), 5u);
  for (const RubOnBranch& at : branch.points) {
    EXPECT_TRUE(at.rub.settled.motion.stable);
    const double r = at.value / 200.0;
    const Phasor exact = 20e-6 * r * r / Phasor(1.0 - r * r, 0.2 * r);
    const auto places = places_of(at.rub);
    ASSERT_EQ(places.size(), 1u) << at.value;
    EXPECT_LT(std::abs(places[0] - exact), 1e-7 * std::abs(exact)) << at.value;
  }
  const nlohmann::json data = bifurcation_data(study, scenes.sample(), {}, all).at("branches");
  EXPECT_TRUE(data.at("refused").is_null());
  const nlohmann::json& line = data.at("lines").at(0);
  EXPECT_EQ(line.at("order"), 1);
  EXPECT_EQ(line.at("points").size(), branch.points.size());
  EXPECT_EQ(line.at("points").at(0).at("x").size(), 1u);
}

// An unbalanced rotor in an elastic ring: a free whirl and a rub, and between them a fold.
TEST(MotionBranches, PassThroughThePlacesOfRuns) {
  test::StudyFolder folder;
  const Study study =
      folder.study("scene = \"" + std::string(ROTORUB_MJCF_DIR) + R"(/bench_annular_elastic.toml"
[sample]
kind = "list"
[[vary]]
key = "rotor.speed"
also = ["force[0].frequency"]
values = ["60 Hz", "80 Hz", "100 Hz", "125 Hz"]
[run]
integrator = "event"
end = "1 s"
)");
  const PointScenes scenes(study, {});
  const auto diagram = bifurcation(scenes, nullptr, {});
  const MotionBranches all = motion_branches(scenes, nullptr, {});
  ASSERT_TRUE(diagram);
  ASSERT_EQ(all.refused, "");
  int compared = 0;
  for (const auto* runs : {&diagram->up, &diagram->down}) {
    for (const BranchPoint& run : *runs) {
      if (run.period != 1) continue;
      ++compared;
      const double value = *scenes.sample().at(run.point).front().number;
      double nearest = 1.0;
      for (const RubBranch& branch : all.found.branches) {
        for (std::size_t k = 0; k + 1 < branch.points.size(); ++k) {
          const RubOnBranch &a = branch.points[k], &b = branch.points[k + 1];
          const double share = (value - a.value) / (b.value - a.value);
          if (!(share >= -0.05 && share <= 1.05) || !a.rub.settled.motion.stable) continue;
          const auto from = places_of(a.rub), to = places_of(b.rub);
          if (from.size() != 1 || to.size() != 1) continue;
          const Phasor place = from[0] + share * (to[0] - from[0]);
          nearest = std::min(nearest, std::abs(place - run.places.back()));
        }
      }
      EXPECT_LT(nearest, 3e-2 * std::abs(run.places.back())) << value;
    }
  }
  EXPECT_GE(compared, 3);
}

TEST(MotionBranches, GiveTheReasonWhereThereAreNone) {
  test::StudyFolder folder;
  folder.write(
      "free.toml",
      test::kFreeRotor +
          std::string("[[force]]\nkind = \"rotating\"\namplitude = 1.0\nfrequency = 77.7\n"));
  const Study study = folder.study(speeds("[100.0, 300.0]"));
  const PointScenes scenes(study, {});
  const MotionBranches none = motion_branches(scenes, nullptr, {});
  EXPECT_NE(none.refused.find("have no common period"), std::string::npos) << none.refused;
  const nlohmann::json data = bifurcation_data(study, scenes.sample(), {}, none);
  EXPECT_EQ(data.at("branches").at("refused"), none.refused);
  EXPECT_NE(data.at("note").get<std::string>().find(none.refused), std::string::npos);
  folder.write("free.toml", test::kFreeRotor);
  const Study one = folder.study(speeds("[100.0]"));
  EXPECT_EQ(motion_branches(PointScenes(one, {}), nullptr, {}).refused,
            "the key has a single value");
}

}  // namespace
}  // namespace rotorub::sweep
