// What [initial] steady refuses: an orbit that touches, that nothing holds or bounds, or that is
// not there yet.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/prepare/steady_scenes.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::magnetic_ring;
using test::steady;

std::string refusal(const scene::Scene& s) {
  const scene::Diagnostic d = test::refusal(s);
  EXPECT_TRUE(d.reason.empty() || d.key == "initial.steady") << d.key;
  return d.reason;
}

void expect_refused(const scene::Scene& s, const std::string& reason) {
  const std::string given = refusal(s);
  EXPECT_NE(given.find(reason), std::string::npos) << given;
}

TEST(SteadyOrbitRefusal, TouchesWithItsSize) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5});
  test::add_rotating_force(s, 99.0, 0.0);
  EXPECT_EQ(refusal(s), "");
  s.forces[0].amplitude = 101.0;
  expect_refused(s, "touches: it comes to 0.000505 m");
  expect_refused(s, "0.0005 m");
  // By the ring's own sag alone.
  scene::Scene sagging = steady({.mass = 1e-3, .damping = 40.0, .stiffness = 2e5});
  test::add_ring(sagging, 10.0, 1.0, 1e4);
  sagging.gravity = scene::Gravity{{0.0, -9.81}, {}};
  expect_refused(sagging, "touches");
}

TEST(SteadyOrbitRefusal, Unstable) {
  scene::Scene s = steady({.mass = 2.0, .damping = 8.0, .stiffness = 2e5, .speed = 900.0});
  s.rotor.modal->internal_damping = {60.0};
  expect_refused(s, "unstable at 900 rad/s, a motion at 318.6");
  s.rotor.speed = 300.0;
  EXPECT_EQ(refusal(s), "");
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {}, 2.1e5}};
  expect_refused(s, "unstable");
}

TEST(SteadyOrbitRefusal, ResonanceAndNothingThatHolds) {
  scene::Scene s = steady({.mass = 2.0, .stiffness = 2e5});
  test::add_rotating_force(s, 1e-9, std::sqrt(1e5));
  expect_refused(s, "resonance");
  s.forces[0].frequency = 300.0;
  EXPECT_EQ(refusal(s), "") << "without damping, but off the resonance: it repeats itself";
  scene::Scene free = steady({.mass = 2.0});
  EXPECT_EQ(refusal(free), "") << "a free mass at rest";
  free.gravity = scene::Gravity{{0.0, -9.81}, {}};
  expect_refused(free, "nothing holds the rotor");
  scene::Scene ring = steady({.mass = 2.0, .stiffness = 2e7});
  test::add_ring(ring, 1.0, 1.0, 0.0);
  ring.gravity = free.gravity;
  expect_refused(ring, "nothing holds the ring");
}

TEST(SteadyOrbitRefusal, MagnetsThatPullTheRingAway) {
  // 4 k_m i_0^2 / s_0^3 = 1.08e6 N/m against 2e4.
  expect_refused(magnetic_ring(), "magnets");
}

TEST(SteadyOrbitRefusal, LoadsThatAreUnderWay) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5});
  test::add_constant_force(s, {1.0, 0.0});
  s.forces[0].on = -0.1;
  s.forces[0].ramp = 0.2;
  expect_refused(s, "still rising");
  s.forces[0].kind = scene::ForceKind::kPulse;
  s.forces[0].ramp = 0.0;
  s.forces[0].off = 0.1;
  expect_refused(s, "pulse is under way");
}

TEST(SteadyOrbitRefusal, BesideAStartOfOnesOwn) {
  const std::string text = R"([rotor]
speed = 300.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[stator]
mass = 1.0
stiffness = 1e5
[contact]
radius = 0.05
clearance = 0.5e-3
friction = 0.1
restitution = 0.5
[initial]
steady = true
)";
  EXPECT_NO_THROW(prepare(scene::parse_scene(text, "s.toml")));
  for (const char* key : {"x", "y", "vx", "vy", "stator", "stator_velocity"}) {
    const bool ring = std::string(key).starts_with("stator");
    const auto wrong = test::refusals([&] {
      scene::parse_scene(text + key + (ring ? " = [0.0, 0.0]\n" : " = [0.0]\n"), "s.toml");
    });
    ASSERT_EQ(wrong.size(), 1U) << key;
    EXPECT_EQ(wrong[0].key, std::string("initial.") + key);
    EXPECT_EQ(wrong[0].line, 17);
    EXPECT_NE(wrong[0].reason.find("steady"), std::string::npos);
  }
}

}  // namespace
}  // namespace rotorub
