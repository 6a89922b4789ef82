// A bounce that comes back to itself, against its closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compare/metrics/attractor.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

constexpr double kMass = 2.0, kOmega = 300.0, kPress = 10.0, kSwing = 1.25 * kPress;
constexpr double kRestitution = 0.5, kClearance = 0.5e-3;
constexpr double kTurn = 2.0 * std::numbers::pi / kOmega;

// m x'' = F + A cos(Omega t) towards the ring, x <= delta_0: two forces that turn in opposite
// senses swing along x. A bounce of one impact a turn has v = F T / (m (1 + eps)) before it and the
// impulse F T, and falls at the phase where sin(Omega t) = pi F (1 - eps) / (A (1 + eps)), the
// later of the two; it is stable where A is little above the least that allows it (P. J. Holmes,
// "The dynamics of repeated impacts with a sinusoidally vibrating table", J. Sound Vib. 84, 1982).
const double kSine =
    std::numbers::pi * kPress * (1.0 - kRestitution) / (kSwing * (1.0 + kRestitution));
const double kSpeed = kPress * kTurn / (kMass * (1.0 + kRestitution));

// The start is a hundredth off the place of such a bounce at t = 0.
scene::Scene pressed(double turns) {
  scene::Scene s = test::make_scene(
      {.mass = kMass, .clearance = kClearance, .restitution = kRestitution, .speed = kOmega});
  test::add_constant_force(s, {kPress, 0.0});
  test::add_rotating_force(s, 0.5 * kSwing, kOmega);
  test::add_rotating_force(s, 0.5 * kSwing, -kOmega);
  const double phase = std::numbers::pi - std::asin(kSine), after = kTurn - phase / kOmega;
  const double push = kPress / kMass, swing = kSwing / kMass / kOmega;
  s.initial.x = {1.01 * (kClearance - kRestitution * kSpeed * after + 0.5 * push * after * after +
                         swing / kOmega * (std::cos(phase) - 1.0) - swing * after * kSine)};
  s.initial.vx = {-kRestitution * kSpeed + push * after - swing * kSine};
  s.run.end = turns * kTurn;
  s.run.output_step = kTurn / 50.0;
  return s;
}

TEST(PeriodicBounce, OfOneImpactATurnIsTold) {
  const Trajectory run = test::run_event(pressed(120.25));
  ASSERT_EQ(run.status, Status::kOk) << run.message;
  const Settled s = settled(run);
  ASSERT_EQ(s.attractor, Attractor::kBouncing);
  const Impact& last = run.impacts.back();
  EXPECT_NEAR(last.normal_impulse / (kPress * kTurn), 1.0, 1e-9);
  EXPECT_NEAR(std::sin(kOmega * last.t), kSine, 1e-6);
  EXPECT_EQ(s.turns, 1);
  EXPECT_EQ(s.bounces, 1);
  EXPECT_EQ(described(s), "bouncing once every turn");
}

// Too early the motion has not yet returned: the answer is only its name.
TEST(PeriodicBounce, ThatHasNotSettledIsBouncing) {
  const Settled s = settled(test::run_event(pressed(8.0)));
  EXPECT_EQ(s.turns, 0);
  EXPECT_EQ(described(s), "bouncing");
}

TEST(PeriodicBounce, IsToldByItsTurnsAndImpacts) {
  Settled s;
  s.attractor = Attractor::kBouncing;
  const auto said = [&](int turns, int bounces) {
    s.turns = turns;
    s.bounces = bounces;
    return described(s);
  };
  EXPECT_EQ(said(1, 2), "bouncing twice every turn");
  EXPECT_EQ(said(3, 5), "bouncing 5 times every 3 turns");
  EXPECT_EQ(said(1, 0), "bouncing, the same every turn");
  s = {.attractor = Attractor::kSynchronousRub};
  EXPECT_EQ(described(s), "synchronous rub");
}

}  // namespace
}  // namespace rotorub
