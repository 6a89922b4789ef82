#include "compare/bench/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/bench/engines.h"
#include "tests/support/native_run.h"

namespace rotorub::bench {
namespace {

using test::shipped;

RunRequest rows(const scene::Scene& scene) {
  RunRequest r;
  r.output_times = common_times(scene.run, {1e-4, 1e-5});
  return r;
}

// Relative to the clearance: differences that a reference must resolve, 100 times smaller than the
// finest level.
constexpr double kFinestLevel = 1e-8;

struct Case {
  const char* scene;
  const char* form;  // empty: none
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }
class Shipped : public testing::TestWithParam<Case> {};

TEST_P(Shipped, IsAHundredTimesTighterThanTheFinestLevel) {
  const scene::Scene scene = shipped(GetParam().scene);
  const Reference r = make_reference(scene, rows(scene));
  EXPECT_EQ(r.source.find("closed form") != std::string::npos, *GetParam().form != '\0')
      << r.source;
  EXPECT_NE(r.source.find(GetParam().form), std::string::npos) << r.source;
  EXPECT_GT(r.error, 0.0) << "nothing is without error";
  const double needed = kFinestLevel * scene.first().contact->clearance / kReferenceMargin;
  EXPECT_LE(r.error, needed);
  // `event` and the closed forms confirm each other.
  EXPECT_LE(r.event_distance, needed);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Shipped,
                         testing::Values(Case{"bench_ring", ""}, Case{"bench_whip", ""},
                                         Case{"bench_billiard", "billiard"},
                                         Case{"bench_drop", "drop"},
                                         Case{"bench_annular_rigid", "annular rub"},
                                         Case{"bench_annular_elastic", "annular rub"}));

// The estimate must not be smaller than the known error: closed forms show the error of `event`,
// and the estimate uses only looser tolerances.
TEST(Reference, EstimateCoversTheTrueErrorOfEvent) {
  for (const char* name : {"bench_annular_elastic", "bench_billiard"}) {
    const scene::Scene scene = shipped(name);
    const auto run = [&](double tolerance) {
      return event_engine(event_parameters(tolerance))->run(scene, rows(scene));
    };
    const Trajectory event = run(1e-10);
    Trajectory exact = event;
    ASSERT_NE(put_closed_form(scene, exact), "");
    const double estimate =
        std::max(position_distance(event, run(3e-10)), position_distance(event, run(1e-9)));
    // Round-off of thousands of operations is added to either.
    EXPECT_LE(position_distance(event, exact), estimate + 1e-15) << name;
  }
}

// A scene with a part that the closed form lacks does not use it.
TEST(ClosedForm, IsLeftOutWhereTheSceneIsAnother) {
  struct Change {
    const char *scene, *override;
  };
  for (const Change& c :
       {Change{"bench_billiard", "contact.restitution=0.9"},
        Change{"bench_billiard", "contact.friction=0.1"},
        Change{"bench_billiard", "rotor.modal.stiffness=[1.0]"},
        Change{"bench_drop", "initial.x=[1e-5]"}, Change{"bench_drop", "contact.restitution=1.0"},
        Change{"bench_annular_rigid", "contact.friction=0.1"},
        Change{"bench_annular_rigid", "initial.vx=[0.0]"},
        Change{"bench_annular_elastic", "stator.damping=100.0"},
        Change{"bench_annular_elastic", "rotor.modal.internal_damping=[1.0]"}}) {
    const scene::Scene scene = shipped(c.scene, {"run.end=0.01", c.override});
    Trajectory t = event_engine(event_parameters(1e-9))->run(scene, {});
    EXPECT_EQ(put_closed_form(scene, t), "") << c.scene << " " << c.override;
  }
}

TEST(CommonTimes, AreEndsOfStepsOfTheWholeLadder) {
  scene::Run run;
  run.end = 0.5;
  const auto times = common_times(run, {2e-4, 1e-4, 5e-5, 2e-5, 1e-6});
  EXPECT_GT(times.size(), 500u);
  EXPECT_LE(times.size(), 1001u);
  EXPECT_EQ(times.back(), 0.5);
  for (const double t : times) {
    for (const double step : {2e-4, 1e-4, 5e-5, 2e-5, 1e-6}) {
      EXPECT_NEAR(t / step, std::round(t / step), 1e-6);
    }
  }
  // There is no useful common grid, so the scene's own rows are used.
  EXPECT_EQ(common_times(run, {1e-5, 3.14159265e-6}).size(), 1001u);
  run.end = 1e-3;
  EXPECT_EQ(common_times(run, {2e-4}).size(), 1001u) << "five rows are too few";
}

}  // namespace
}  // namespace rotorub::bench
