// The periodic rubs of `modes --periodic`: against the closed forms, and of machines without them.
#include "compare/modes/periodic_rubs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "compare/modes/periodic_rubs_text.h"
#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "native_model/control/library_file.h"
#include "native_model/periodic/motion_record.h"
#include "native_model/periodic/return_map.h"
#include "native_model/prepare/prepare.h"
#include "tests/native_model/periodic/bounce_once_a_turn.h"
#include "tests/native_model/periodic/sampled_ring.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using Words = std::vector<std::string>;

constexpr double kTurn = 2.0 * std::numbers::pi;
const char* const kWeight = "gravity.acceleration=[0.0, -9.81]";

// The only rub, which comes back to itself when it is run for three periods.
PeriodicRub only_rub(const scene::Scene& scene) {
  const PeriodicRubs all = lasting_rubs_by_shooting(scene);
  EXPECT_EQ(all.refused, "");
  EXPECT_EQ(all.rubs.size(), 1u);
  if (all.rubs.size() != 1) return {};
  const periodic::PeriodicMotion& motion = all.rubs[0].settled.motion;
  EXPECT_TRUE(motion.stable);
  EXPECT_LE(motion.residual, 1e-10);
  EXPECT_LT(all.rubs[0].largest_multiplier(), 1.0);
  const Model model = prepare(scene);
  const periodic::Return back =
      periodic::ReturnMap(model).at(motion.start, 3.0 * motion.period, 3 * motion.turns);
  EXPECT_LT(back.residual, 1e-8);
  return all.rubs[0];
}

// The rub of this kind that the closed forms list, if it is the only stable one.
rub::SteadyRub listed(const scene::Scene& scene, rub::RubKind kind) {
  const auto analyses = analyse_rubs(scene, {scene.rotor.speed});
  const rub::StandingRub* rub = analyses.at(0).at.at(0).point.leading(kind);
  EXPECT_TRUE(rub && rub->stability.stable);
  return rub ? rub->rub : rub::SteadyRub{};
}

void expect_equal(const PeriodicRub& found, const rub::SteadyRub& expected) {
  const periodic::ContactFigures& f = found.figures.at(0);
  EXPECT_NEAR(f.whirl, expected.whirl, 1e-8 * std::abs(expected.whirl));
  EXPECT_NEAR(f.mean_force, expected.normal_force, 1e-8 * expected.normal_force);
  EXPECT_NEAR(f.largest_force, expected.normal_force, 1e-8 * expected.normal_force);
  EXPECT_NEAR(f.contact_share, 1.0, 1e-12);
  EXPECT_EQ(f.impacts, 0);
}

TEST(PeriodicRubs, AgreeWithTheClosedFormsWhip) {
  const scene::Scene scene = test::shipped("bench_whip");
  const PeriodicRub found = only_rub(scene);
  EXPECT_EQ(found.kind, "backward whip");
  EXPECT_EQ(found.starts, (Words{"the scene's start", "whip"}));
  EXPECT_EQ(found.settled.order, 0) << "nothing depends on time";
  expect_equal(found, listed(scene, rub::RubKind::kWhip));
}

TEST(PeriodicRubs, AgreeWithTheClosedFormsSynchronousRub) {
  const scene::Scene scene = test::shipped("bench_annular_elastic");
  const PeriodicRub found = only_rub(scene);
  EXPECT_EQ(found.kind, "synchronous rub");
  EXPECT_EQ(found.settled.order, 1);
  expect_equal(found, listed(scene, rub::RubKind::kForced));
}

TEST(PeriodicRubs, AWhipUnderWeight) {
  const PeriodicRub found = only_rub(test::shipped("bench_whip", {kWeight}));
  EXPECT_EQ(found.kind, "backward whip");
  const periodic::ContactFigures& f = found.figures[0];
  EXPECT_NEAR(f.whirl * found.settled.motion.period, -kTurn, 1e-6);
  EXPECT_GT(f.largest_force, f.mean_force + 10.0);
}

TEST(PeriodicRubs, ASynchronousRubUnderWeight) {
  const scene::Scene scene =
      test::shipped("bench_annular_elastic", {kWeight, "stator.stiffness=3e5"});
  const PeriodicRub found = only_rub(scene);
  EXPECT_EQ(found.kind, "synchronous rub");
  EXPECT_NEAR(found.figures[0].whirl, scene.forces[0].frequency, 1e-6);
  EXPECT_GT(found.figures[0].largest_force, found.figures[0].mean_force + 2.0);
}

// Whichever way the rotor spins: without friction nothing depends on it.
TEST(PeriodicRubs, ARubThatGoesWithItsLoadIsSynchronous) {
  const Words smooth{"contact.friction=0"};
  const PeriodicRub with = only_rub(test::shipped("bench_annular_elastic", smooth));
  scene::Scene scene = test::shipped("bench_annular_elastic", smooth);
  scene.rotor.speed *= -1.0;
  const PeriodicRub against = only_rub(scene);
  EXPECT_EQ(with.kind, "synchronous rub");
  EXPECT_EQ(against.kind, "synchronous rub");
  EXPECT_NEAR(against.figures[0].mean_force, with.figures[0].mean_force,
              1e-9 * with.figures[0].mean_force);
}

TEST(PeriodicRubs, ACompliantRing) {
  const PeriodicRub found = only_rub(test::shipped("compliant_ring"));
  EXPECT_EQ(found.kind, "synchronous rub");
  EXPECT_EQ(found.settled.order, 1) << "the shortest period";
}

TEST(PeriodicRubs, StickSlipWithFallingFriction) {
  const PeriodicRub found = only_rub(test::shipped("falling_friction"));
  EXPECT_EQ(found.kind, "stick-slip");
  EXPECT_GT(found.figures[0].stuck_share, 0.3);
}

// Without damping (Holmes 1982) the bounce doubles its period at `doubling_swing`.
TEST(PeriodicRubs, ABounceAndItsSubHarmonic) {
  test::BounceOnceATurn bounce;
  const double doubling = bounce.doubling_swing();
  for (const int order : {1, 2}) {
    bounce.swing = (order == 1 ? 0.95 : 1.05) * doubling;
    scene::Scene scene = bounce.scene();
    scene.rotor.modal->damping = {0.5};
    const PeriodicRub found = only_rub(scene);
    EXPECT_EQ(found.kind, "bouncing");
    EXPECT_EQ(found.settled.order, order);
    EXPECT_EQ(found.figures.at(0).impacts, order);
    EXPECT_NEAR(found.settled.motion.period, order * bounce.period(), 1e-12);
    const std::string text =
        result::text_of({.parts = {periodic_rubs_result({{""}, {found}, {}, "", ""})}});
    EXPECT_EQ(text.find("bouncing, sub-harmonic 1/2") != std::string::npos, order == 2) << text;
  }
}

// A start that rubs does not lead to it.
TEST(PeriodicRubs, TheFreeOrbitIsListedBesideTheRub) {
  const scene::Scene scene =
      test::shipped("bench_annular_elastic", {"force[0].frequency=125 Hz", "rotor.speed=125 Hz"});
  const PeriodicRubs all = lasting_rubs_by_shooting(scene);
  const auto free = std::ranges::find(all.rubs, "no contact", &PeriodicRub::kind);
  ASSERT_NE(free, all.rubs.end());
  EXPECT_NE(std::ranges::find(free->starts, "the free orbit"), free->starts.end());
  EXPECT_TRUE(free->settled.motion.stable);
}

// One motion is listed once, although its largest force is sampled at other instants.
TEST(PeriodicRubs, AreListedOnceWithAllStarts) {
  const PeriodicRub found = only_rub(
      test::shipped("bench_annular_elastic",
                    {"initial={}", "gravity.acceleration=[0.0, -40.0]", "force[0].amplitude=60",
                     "stator.stiffness=3e5", "contact.friction=0.05"}));
  EXPECT_EQ(found.starts, (Words{"the scene's start", "synchronous rub", "whip"}));
}

// Unlike planes of the ring have no closed form, and the scene starts in the middle, so that only
// the backward start finds the whip.
TEST(PeriodicRubs, ABackwardStartFindsAWhip) {
  const scene::Scene scene =
      test::shipped("bench_whip", {"stator.stiffness=[1.1e6, 0.9e6]", "initial={}"});
  EXPECT_NE(analyse_rubs(scene, {scene.rotor.speed}).front().refused, "");
  const PeriodicRubs all = lasting_rubs_by_shooting(scene);
  ASSERT_EQ(all.rubs.size(), 1u);
  EXPECT_EQ(all.rubs[0].kind, "backward whip");
  EXPECT_EQ(all.rubs[0].starts, Words{"backward whirl"});
  ASSERT_EQ(all.without.size(), 1u);
  EXPECT_EQ(all.without[0].why, "the run comes to rest");
}

TEST(PeriodicRubs, AShaftInTwoRingsNightly) {
  const scene::Scene scene = test::shipped("two_catchers");
  const PeriodicRub found = only_rub(scene);
  EXPECT_EQ(found.kind, "rub on one side");
  const nlohmann::json printed =
      result::json_of({.parts = {periodic_rubs_result(lasting_rubs_by_shooting(scene))}});
  const nlohmann::json& rub = printed.at("rubs").at(0);
  EXPECT_EQ(rub.at("contacts").size(), 2u);
  EXPECT_EQ(rub.at("contact"), rub.at("contacts").at(found.contact).at("name"));
}

TEST(PeriodicRubs, SayWhatTheyChangeInASampledControl) {
  const Words law{"rotor.speed=\"52.5 Hz\"",
                  "controller.kind=\"cross_coupled\"",
                  "controller.feedback=[300.0]",
                  "controller.damping=300.0",
                  "controller.sensors.delay=\"400 us\"",
                  "controller.sensors.position_noise=1e-7"};
  const PeriodicRubs all = lasting_rubs_by_shooting(test::sampled_ring(law));
  ASSERT_FALSE(all.rubs.empty());
  EXPECT_EQ(all.rubs[0].kind, "synchronous rub");
  EXPECT_EQ(all.sampling,
            "The sample time of the control is 200.5013 instead of 200 us, so that it divides the "
            "period of the loads. The search ignores the noise and the resolution of the sensors.");
}

TEST(PeriodicRubs, AreRefusedWithALawThatIsNotRun) {
  set_scene_libraries(SceneLibraries::kLeftOut);
  const PeriodicRubs none = lasting_rubs_by_shooting(
      test::sampled_ring({"controller.kind=\"library\"", "controller.library=\"law.so\""}));
  set_scene_libraries(SceneLibraries::kAsked);
  EXPECT_EQ(none.refused,
            "this command does not run the user's control law, so the motion is unknown");
}

TEST(PeriodicRubs, SayWhyThereIsNone) {
  const PeriodicRubs refused = lasting_rubs_by_shooting(test::shipped("earthquake"));
  EXPECT_NE(refused.refused.find("motion of the base"), std::string::npos) << refused.refused;
  EXPECT_NE(result::text_of({.parts = {periodic_rubs_result(refused)}}).find("none can be found: "),
            std::string::npos);
  ShootingOptions little;
  little.most_stretches = 2000;
  const PeriodicRubs none = lasting_rubs_by_shooting(test::shipped("two_catchers"), little);
  EXPECT_TRUE(none.rubs.empty());
  EXPECT_NE(none.without.at(0).why.find("limit of effort"), std::string::npos)
      << none.without.at(0).why;
}

// Rolling under weight and a load has two frequencies here, so no period; the result says what the
// run does.
TEST(PeriodicRubs, SayWhatARunFromABackwardStartDoesWithoutAPeriod) {
  scene::Scene scene =
      test::shipped("bench_whip", {kWeight, "contact.friction=0.4", "contact.radius=0.05037"});
  test::add_rotating_force(scene, 5.0, scene.rotor.speed);
  const PeriodicRubs all = lasting_rubs_by_shooting(scene);
  ASSERT_FALSE(all.without.empty());
  EXPECT_NE(all.without[0].why.find("; at the end: rolling, whirl -"), std::string::npos)
      << all.without[0].why;
}

TEST(PeriodicRubs, StandInTheResultIfAskedFor) {
  const scene::Scene scene = test::shipped("compliant_ring");
  RotorAnalysis analysis = analyse_rotor(scene, {});
  const std::string before = result::text_of(modes_result("a", analysis));
  EXPECT_NE(before.find("--periodic finds"), std::string::npos);
  EXPECT_FALSE(result::json_of(modes_result("a", analysis)).contains("periodic_rubs"));
  analysis.periodic_rubs = lasting_rubs_by_shooting(scene);
  const std::string after = result::text_of(modes_result("a", analysis));
  EXPECT_EQ(after.find("--periodic finds"), std::string::npos);
  EXPECT_NE(after.find("synchronous rub"), std::string::npos) << after;
  const nlohmann::json printed = result::json_of(modes_result("a", analysis));
  const nlohmann::json& rub = printed.at("rubs").at(0);
  EXPECT_EQ(rub.at("kind"), "synchronous rub");
  EXPECT_TRUE(rub.at("stable"));
  EXPECT_TRUE(rub.at("source").get<std::string>().starts_with("shooting from a run: "));
  const double real = rub.at("multipliers").at(0).at(0),
               imaginary = rub.at("multipliers").at(0).at(1);
  EXPECT_NEAR(std::hypot(real, imaginary), rub.at("multiplier").get<double>(), 1e-15);
  EXPECT_NEAR(rub.at("whirl").get<double>(), 100.0 * std::numbers::pi, 1e-6);
  EXPECT_TRUE(printed.at("periodic_rubs").at("refused").is_null());
  const nlohmann::json page = page_json(modes_result("a", analysis));
  EXPECT_NE(page.dump().find("periodic rub"), std::string::npos);
}

}  // namespace
}  // namespace rotorub
