// Diagrams that are known: of a rotor that touches nothing, the vector of its unbalance.
#include "compare/sweep/bifurcation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/sweep/page_data.h"
#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

using Phasor = std::complex<double>;

const char* const kStudy = R"(scene = "free.toml"
[sample]
kind = "grid"
[[vary]]
key = "rotor.speed"
from = 100.0
to = 300.0
count = 5
[run]
integrator = "event"
)";

TEST(Bifurcation, OfAFreeRotorIsItsUnbalanceVector) {
  test::StudyFolder folder;
  folder.write("free.toml", test::kFreeRotor);
  const Study study = folder.study(kStudy);
  ASSERT_EQ(no_bifurcation(study), "");
  const PointScenes scenes(study, {});
  const auto diagram = bifurcation(scenes, nullptr, {});
  ASSERT_TRUE(diagram);
  EXPECT_EQ(diagram->not_continued, "");
  ASSERT_EQ(diagram->up.size(), 5u);
  ASSERT_EQ(diagram->down.size(), 5u);
  for (const auto* branch : {&diagram->up, &diagram->down}) {
    for (const BranchPoint& point : *branch) {
      EXPECT_EQ(point.refused, "");
      EXPECT_EQ(point.continued, &point != &branch->front());
      const double r = (100.0 + 50.0 * static_cast<double>(point.point)) / 200.0;
      const Phasor exact = 20e-6 * r * r / Phasor(1.0 - r * r, 0.2 * r);
      ASSERT_GE(point.places.size(), 7u);
      EXPECT_EQ(point.period, 1) << r;
      // It decays with 20 1/s: e^-10 is left after half of the run.
      EXPECT_LT(std::abs(point.places.back() - exact), 1e-3 * std::abs(exact)) << r;
    }
  }
  EXPECT_EQ(diagram->down.front().point, 4);
  for (const BranchPoint& point : diagram->up) {
    ASSERT_TRUE(point.exponent);
    EXPECT_NEAR(*point.exponent, -20.0, 1.5) << "-zeta omega";
  }
  for (const BranchPoint& point : diagram->down) EXPECT_FALSE(point.exponent);

  const nlohmann::json data = bifurcation_data(study, scenes.sample(), *diagram);
  EXPECT_EQ(data.at("key").at("unit"), "Hz");
  EXPECT_EQ(data.at("note"), "Each value begins where the one before it ended.");
  EXPECT_NEAR(data.at("up")[4].at("value").get<double>(), 300.0 / 2.0 / std::numbers::pi, 1e-3);
  EXPECT_EQ(data.at("up")[4].at("x").size(), 1u) << "a motion of one turn once";
}

// An unbalanced rotor in an elastic ring (mjcf/studies/speed_bifurcation.toml): at 100 Hz it rubs
// on its way up, and on its way down it whirls freely, F / (k - m w^2 + i d w).
TEST(Bifurcation, FollowsTwoMotionsThatStandSideBySide) {
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
  const auto diagram = bifurcation(PointScenes(study, {}), nullptr, {});
  ASSERT_TRUE(diagram);
  const BranchPoint &up = diagram->up[2], &down = diagram->down[1];
  ASSERT_EQ(up.point, 2);
  ASSERT_EQ(down.point, 2);
  const double w = 200.0 * std::numbers::pi;
  const Phasor free = 150.0 / Phasor(2e5 - 2.0 * w * w, 40.0 * w);
  ASSERT_LT(std::abs(free), 0.5e-3) << "it has room in the ring";
  EXPECT_LT(std::abs(std::abs(down.places.back()) - std::abs(free)), 1e-2 * std::abs(free));
  EXPECT_GT(std::abs(up.places.back() - down.places.back()), 0.1 * std::abs(free));
  EXPECT_EQ(up.period, 1);
  ASSERT_TRUE(up.exponent);
  EXPECT_LT(*up.exponent, 0.0);
}

// A ring that is narrower than where the rotor is: no start there, and the scene's own instead.
TEST(Bifurcation, BeginsAnewWhereTheLastStateDoesNotFit) {
  test::StudyFolder folder;
  folder.write("free.toml", test::kFreeRotor);
  const Study study = folder.study(R"(scene = "free.toml"
[sample]
kind = "list"
[[vary]]
key = "contact.clearance"
values = [1e-5, 5e-3]
[run]
integrator = "event"
end = 0.5
)");
  const auto diagram = bifurcation(PointScenes(study, {}), nullptr, {});
  ASSERT_TRUE(diagram);
  for (const auto* branch : {&diagram->up, &diagram->down})
    for (const BranchPoint& point : *branch) ASSERT_EQ(point.refused, "") << point.point;
  EXPECT_TRUE(diagram->up[1].continued) << "into a wider ring";
  ASSERT_EQ(diagram->down[0].point, 1);
  EXPECT_GT(std::abs(diagram->down[0].places.back()), 1e-5)
      << "it whirls wider than the narrow one";
  EXPECT_FALSE(diagram->down[1].continued);
  const nlohmann::json data = bifurcation_data(study, PointScenes(study, {}).sample(), *diagram);
  EXPECT_NE(data.at("note").get<std::string>().find("for 1 that could not"), std::string::npos)
      << data.at("note");
}

TEST(Bifurcation, RefusesUnsupportedScenes) {
  test::StudyFolder folder;
  folder.write("free.toml", test::kFreeRotor);
  EXPECT_EQ(no_bifurcation(folder.study(kStudy)), "");
  Study study = folder.study(kStudy);
  study.engine = EngineKind::kMujoco;
  EXPECT_NE(no_bifurcation(study), "");
  study = folder.study(kStudy);
  study.vary.push_back(study.vary.front());
  EXPECT_NE(no_bifurcation(study), "");
  study = folder.study(kStudy);
  study.vary.front().values = {{"event", std::nullopt}};
  EXPECT_NE(no_bifurcation(study), "");
}

}  // namespace
}  // namespace rotorub::sweep
