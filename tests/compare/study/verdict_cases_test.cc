// Scenes in which verdicts once depended on bookkeeping: on the step that has a force, on how
// impacts are counted.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "compare/study/answer.h"
#include "compare/study/scene_comparison.h"
#include "compare/study/verdict.h"
#include "tests/support/jeffcott.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

CompareOptions quick(int twins) {
  CompareOptions options;
  options.timing_repeats = 1;
  options.twins = twins;
  options.modes_ladder = false;
  return options;
}

const FigureDifference& of(const ComparedModel& m, const std::string& key) {
  for (const FigureDifference& f : m.figures) {
    if (f.figure->key == key) return f;
  }
  throw std::out_of_range(key);
}

// 2 kg that land once and stay, in a ring on springs and a damper.
constexpr const char* kLanding = R"(
[run]
end = 0.2
step = 2e-5
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [0.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.0
restitution = 0.0
[stator]
mass = 1.0
damping = 400.0
stiffness = 1e5
[gravity]
acceleration = [0.0, -9.81]
)";

TEST(VerdictCases, ALandingIsTheSameAtEveryStep) {
  for (const char* step : {"2e-4", "2e-5", "5e-6"}) {
    const SceneComparison c =
        compare_scene(parsed(kLanding, {std::string("run.step=") + step}), quick(2));
    ASSERT_EQ(c.models[0].run.label, "rigid");
    EXPECT_EQ(c.models[0].trust, Trust::kYes) << step << ": " << answer_row(c, c.models[0]).why;
    EXPECT_LT(std::abs(of(c.models[0], "impact_impulse").deviation), 1e-3) << step;
    EXPECT_LT(std::abs(of(c.models[0], "impulse_total").deviation), 1e-5) << step;
  }
}

// Hundreds of impacts: each counts as a step of contact, without being part of the lasting contact.
TEST(VerdictCases, ImpactsStepsAreNoLastingContact) {
  const SceneComparison c =
      compare_scene(shipped("bench_billiard", {"run.step=5e-5", "run.end=0.5"}), quick(0));
  const ComparedModel& rigid = c.models[0];
  ASSERT_GT(c.native.metrics.impacts, 100u);
  EXPECT_GT(of(rigid, "contact_fraction").deviation, 0.005);
  EXPECT_EQ(rigid.run.metrics.lasting_fraction, 0.0);
  EXPECT_EQ(c.native.metrics.lasting_fraction, 0.0);
  EXPECT_NE(of(rigid, "lasting_fraction").verdict, FigureVerdict::kOutside);
}

// A shadow whose step is too long has no figures.
TEST(VerdictCases, AShadowThatStoppedIsNotShown) {
  const SceneComparison c =
      compare_scene(shipped("bench_ring", {"run.step=0.02", "run.end=0.1"}), quick(0));
  EXPECT_FALSE(c.shadow.side);
  EXPECT_NE(c.shadow.absent.find("step"), std::string::npos) << c.shadow.absent;
}

// The rotor sinks into a wide ring by 2 % of its clearance and into a narrow one by 20 %.
TEST(VerdictCases, ADepthIsAShareOfItsOwnClearanceInAnyOrder) {
  SceneComparison c;
  c.scene = make_scene({.clearance = 0.5e-3});
  c.scene.auxiliary.push_back(c.scene.first());
  c.scene.auxiliary[1].name = "narrow";
  c.scene.auxiliary[1].contact->clearance = 0.1e-3;
  ComparedModel& m = c.models.emplace_back();
  Statistics& s = m.run.trajectory.statistics;
  s.max_penetration = m.run.metrics.max_penetration = 20e-6;
  s.contacts.resize(2);
  s.contacts[0].max_penetration = 10e-6;
  s.contacts[1].max_penetration = 20e-6;
  for (const Figure& f : figures()) {
    FigureDifference difference;
    difference.figure = &f;
    m.figures.push_back(difference);
  }
  for (const char* order : {"wide ring first", "narrow ring first"}) {
    SCOPED_TRACE(order);
    const std::vector<std::string> why = reasons(c, m);
    ASSERT_EQ(why.size(), 1U);
    EXPECT_EQ(why[0],
              "the rotor sinks 20 µm into the ring of contact narrow, 20 % of the clearance");
    std::swap(c.scene.auxiliary[0], c.scene.auxiliary[1]);
    std::swap(s.contacts[0], s.contacts[1]);
  }
}

// A rotor that turns within two rings without touching them.
constexpr const char* kWithinTwoRings = R"(
[run]
end = 0.002
step = 1e-5
[rotor]
speed = 100.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[initial]
x = [1e-5]
)";
constexpr const char* kWideRing =
    "[[contact]]\nradius = 0.05\nclearance = \"0.5 mm\"\nfriction = 0.1\nrestitution = 0.5\n";
constexpr const char* kNarrowRing =
    "[[contact]]\nradius = 0.05\nclearance = \"0.1 mm\"\nfriction = 0.1\nrestitution = 0.5\n";

TEST(VerdictCases, RunsPartByAShareOfTheSmallestClearanceInAnyOrder) {
  const auto threshold = [](const std::string& rings) {
    return compare_scene(parsed(kWithinTwoRings + rings), quick(0)).twin.threshold;
  };
  const std::string wide = kWideRing, narrow = kNarrowRing;
  EXPECT_DOUBLE_EQ(threshold(wide + narrow), kDivergenceShare * 0.1e-3);
  EXPECT_EQ(threshold(narrow + wide), threshold(wide + narrow));
}

// Chaos: runs on both sides tell what one of them could not.
TEST(VerdictCasesLong, TwinsOnBothSidesTellTheDifference) {
  const SceneComparison c =
      compare_scene(shipped("paper_passive", {"run.step=2e-5", "run.end=0.5"}), quick(6));
  EXPECT_EQ(c.decider_twins, 6);
  double widest = 0.0;
  for (const FigureDifference& f : c.models[0].figures) {
    EXPECT_GE(f.least_detectable, f.interval);
    if (f.figure->is_judged()) widest = std::max(widest, f.interval);
  }
  EXPECT_GT(widest, 0.001);
}

}  // namespace
}  // namespace rotorub::test
