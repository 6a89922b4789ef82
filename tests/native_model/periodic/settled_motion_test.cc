// The periodic motion to which a run settles.
#include "native_model/periodic/settled_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/periodic/forcing.h"
#include "native_model/periodic/return_map.h"
#include "native_model/prepare/prepare.h"
#include "native_model/prepare/repeating_model.h"
#include "tests/native_model/periodic/bounce_once_a_turn.h"
#include "tests/native_model/periodic/levitated_rotor.h"
#include "tests/native_model/periodic/sampled_ring.h"
#include "tests/support/native_run.h"

namespace rotorub::periodic {
namespace {

SettledMotion settled(const scene::Scene& scene, SettlingParameters parameters = {}) {
  const Model model = prepare(scene);
  parameters.duration = scene.run.end;
  const SettledMotion found = settled_motion(model, initial_state(model), parameters);
  if (found.found()) {
    const PeriodicMotion& m = found.motion;
    EXPECT_TRUE(m.stable);
    const ReturnMap map(model, {}, m.frame != 0.0);
    EXPECT_LT(map.at(m.start, 3.0 * m.period, 3 * m.turns).residual, 1e-8);
    EXPECT_GE(found.run_time, scene.run.end);
  }
  return found;
}

bool says(const SettledMotion& none, const std::string& words) {
  return none.refusal.find(words) != std::string::npos;
}

// The run first comes back closely after three periods, but it settles to a motion of one.
TEST(SettledMotion, HasTheShortestPeriod) {
  const SettledMotion found = settled(test::shipped("compliant_ring"));
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.order, 1);
  EXPECT_NEAR(found.motion.period, 0.02, 1e-12);
}

TEST(SettledMotion, IsSubHarmonicBeyondAPeriodDoubling) {
  test::BounceOnceATurn bounce;
  bounce.swing = 1.05 * bounce.doubling_swing();
  scene::Scene scene = bounce.scene();
  scene.rotor.modal->damping = {0.5};
  const SettledMotion found = settled(scene);
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.order, 2);
  EXPECT_NEAR(found.motion.period, 2.0 * bounce.period(), 1e-12);
  SettlingParameters once;
  once.most_periods = 1;
  const SettledMotion none = settled(scene, once);
  EXPECT_FALSE(none.found()) << "the bounce once a turn is unstable";
  EXPECT_TRUE(says(none, "over at most 1 period")) << none.refusal;
}

// With little damping a rotor with gyroscopic moments bounces for ever a little above the speeds
// w_B + 2 w_F and (w_B + 3 w_F) / 2 (Shaw, Champneys and Friswell 2016), beside its free orbit. The
// bounce repeats in the frame of the unbalance.
struct Resonance {
  double at_rest;       // rad/s, the condition with the whirls at this speed
  double speed, force;  // rad/s, N
  double damping, vx, vy;
  int backward, forward, divisor;  // (backward w_B + forward w_F) / divisor
};

constexpr double kResonant = 1e4, kGyroscopic = 0.143;  // N/m, kg, of 1 kg

scene::Scene resonant_rotor(const Resonance& of, double speed) {
  scene::Scene scene = test::make_scene({.mass = 1.0,
                                         .damping = of.damping,
                                         .stiffness = kResonant,
                                         .clearance = 1e-3,
                                         .restitution = 1.0,
                                         .speed = speed});
  scene.rotor.modal->gyroscopic = {kGyroscopic};
  scene.first().contact->compliance = Compliance{.stiffness = 1.32 * kResonant, .damping = 0.0};
  test::add_rotating_force(scene, of.force, speed);
  scene.initial.vx = {of.vx};
  scene.initial.vy = {of.vy};
  scene.run.end = 6.0;
  return scene;
}

TEST(SettledMotion, BouncesByInternalResonance) {
  for (const Resonance& of :
       {Resonance{332.2, 355.54, 38.0, 2.0, -0.001, 0.004, 1, 2, 1},
        Resonance{218.0, 235.794672, 17.0, 0.6, 0.085992, -0.0650914, 1, 3, 2}}) {
    const double half = 0.5 * kGyroscopic * of.at_rest, root = std::sqrt(half * half + kResonant);
    EXPECT_NEAR((of.backward * (root - half) + of.forward * (root + half)) / of.divisor, of.at_rest,
                0.2);
    const SettledMotion found = settled(resonant_rotor(of, of.speed));
    ASSERT_TRUE(found.found()) << found.refusal;
    EXPECT_EQ(found.motion.frame, of.speed);
    EXPECT_EQ(found.order, 0) << "its period is its own";
    EXPECT_GT(of.speed, of.at_rest);
    EXPECT_LT(of.speed, 1.1 * of.at_rest);
  }
}

// Below the resonance the same start leads to the free orbit, which rests in that frame.
TEST(SettledMotion, AFreeOrbitIsSeenAtRest) {
  const Resonance of{332.2, 355.54, 38.0, 2.0, -0.001, 0.004, 1, 2, 1};
  const SettledMotion found = settled(resonant_rotor(of, 330.0));
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.motion.frame, 0.0);
  EXPECT_EQ(found.order, 1);
}

// 70 Hz: 285.7 samples of 50 us in a turn, of which the motion has 286.
TEST(SettledMotion, OfSampledMagneticBearings) {
  scene::Scene scene = test::levitated_rotor();
  scene.rotor.speed = 2.0 * std::numbers::pi * 70.0;
  const Model given = prepare(scene), model = repeating_model(scene, given, prepare);
  EXPECT_NE(forcing_of(given).refusal, "");
  const double period = 1.0 / 70.0;
  EXPECT_NEAR(model.samplers[0].sample_time, period / 286.0, 1e-16);
  const SettledMotion found = settled_motion(model, initial_state(model), {.duration = 0.5});
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.order, 1);
  EXPECT_NEAR(found.motion.period, period, 1e-12);
  EXPECT_TRUE(found.motion.stable);
  EXPECT_LT(ReturnMap(model).at(found.motion.start, 5.0 * period, 0).residual, 1e-8);
}

TEST(SettledMotion, OfSampledControllersOfARing) {
  std::vector<std::vector<std::string>> laws = test::sampled_laws();
  laws.push_back(laws.front());
  laws.back().emplace_back("controller.on=\"50 ms\"");
  laws.back().emplace_back("controller.trigger.touch=true");
  for (const std::vector<std::string>& law : laws) {
    SCOPED_TRACE(testing::PrintToString(law));
    const scene::Scene scene = test::sampled_ring(law);
    const Model model = repeating_model(scene, prepare(scene), prepare);
    const SettledMotion found = settled_motion(model, initial_state(model), {.duration = 0.4});
    ASSERT_TRUE(found.found()) << found.refusal;
    EXPECT_TRUE(found.motion.stable);
    const double period = 5.0 * found.motion.period;
    EXPECT_LT(ReturnMap(model).at(found.motion.start, period, 0).residual, 1e-8);
    EXPECT_EQ(found.order, 1);
  }
}

// 100 and 160 samples a turn: every fifth instant in the middle of the shorter time is a sample of
// the other ring.
TEST(SettledMotion, OfTwoSampledRings) {
  std::string text = R"(
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0, 3.0]
stiffness = [2e5, 4e5]
damping = [40.0, 60.0]
[[force]]
kind = "synchronous"
amplitude = 150.0
shape = [1.0, 0.5]
)";
  for (const char* rest : {"shape = [1.0, 1.0]\n|200 us", "shape = [-0.4, 1.0]\n|125 us"}) {
    const std::string both = rest, shape = both.substr(0, both.find('|'));
    text +=
        "[[contact]]\nradius = 0.05\nclearance = \"0.5 mm\"\nfriction = 0.1\nrestitution = 0.3\n" +
        shape +
        "[contact.stator]\nmass = 1.0\ndamping = 200.0\nstiffness = 1e5\n"
        "[contact.controller]\nkind = \"cross_coupled\"\nfeedback = [300.0]\n"
        "damping = 300.0\nsample_time = \"" +
        both.substr(both.find('|') + 1) + "\"\n";
  }
  const scene::Scene scene = scene::parse_scene(text, "two_rings");
  const Model model = repeating_model(scene, prepare(scene), prepare);
  EXPECT_EQ(sample_times(model), (std::vector<double>{2e-4, 1.25e-4}));
  const SettledMotion found = settled_motion(model, initial_state(model), {.duration = 0.4});
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.order, 1);
  const double period = 5.0 * found.motion.period;
  EXPECT_LT(ReturnMap(model).at(found.motion.start, period, 0).residual, 1e-8);
}

TEST(SettledMotion, OfAFreePeriodHasNoOrder) {
  const SettledMotion found = settled(test::shipped("bench_whip"));
  ASSERT_TRUE(found.found()) << found.refusal;
  EXPECT_EQ(found.order, 0);
}

TEST(SettledMotion, IsNoneIfTheRunComesToRest) {
  const SettledMotion none = settled(test::shipped("bench_drop"));
  EXPECT_EQ(none.refusal, "the run comes to rest");
  const SettledMotion decays =
      settled(test::shipped("bench_whip", {"contact.friction=0.0", "run.end=0.2"}));
  EXPECT_EQ(decays.refusal, "the run comes to rest");
}

TEST(SettledMotion, EndsAtItsLimitOfEffort) {
  SettlingParameters little;
  little.most_stretches = 3000;
  const SettledMotion none = settled(test::shipped("two_catchers"), little);
  EXPECT_TRUE(says(none, "limit of effort")) << none.refusal;
}

TEST(SettledMotion, RefusesWhatDoesNotRepeat) {
  EXPECT_TRUE(says(settled(test::shipped("earthquake")), "motion of the base"));
}

}  // namespace
}  // namespace rotorub::periodic
