// Motions along the ring: orbits as wide as the clearance, to the last digit, with little or no
// contact force. (A swing whose slip reverses: mjcf/hard/reversal.toml.)
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::make_scene;

// most: the allowed number of events; there are a few at the start of a stable orbit.
void expect_orbit(const scene::Scene& scene, std::size_t most = 5) {
  const Trajectory t = test::run_event(scene);
  EXPECT_EQ(t.end, scene.run.end);
  const double delta = scene.first().contact->clearance;
  for (const double gap : t.column("gap")) ASSERT_NEAR(gap, 0.0, 1e-9 * delta);
  EXPECT_LE(t.events.size(), most);
}

TEST(Orbit, AFreeMassAlongTheRing) {
  for (const double angle : {0.0, 0.3, 1.0, 2.0}) {
    SCOPED_TRACE(angle);
    scene::Scene scene = make_scene({.mass = 2.0});
    const double delta = scene.first().contact->clearance, v = 0.3;
    scene.initial.x = {delta * std::cos(angle)};
    scene.initial.y = {delta * std::sin(angle)};
    scene.initial.vx = {-v * std::sin(angle)};
    scene.initial.vy = {v * std::cos(angle)};
    scene.run.end = 0.1;
    expect_orbit(scene);
  }
}

// Only a spring holds the rotor: it touches the ring without a force.
TEST(Orbit, OfASpringAsWideAsTheClearance) {
  for (const double stiffness : {2e5, 3e5, 1.7e4}) {
    SCOPED_TRACE(stiffness);
    scene::Scene scene = make_scene({.mass = 2.0, .stiffness = stiffness});
    const double delta = scene.first().contact->clearance;
    scene.initial.x = {delta};
    scene.initial.vy = {delta * std::sqrt(stiffness / 2.0)};
    scene.run.end = 0.2;
    expect_orbit(scene);
  }
}

TEST(Orbit, OfARotatingForceAsWideAsTheClearance) {
  const double mass = 2.0, delta = 0.5e-3;
  for (const double frequency : {100.0, 314.159, 400.0}) {
    for (const double stiffness : {0.0, 3e5}) {
      SCOPED_TRACE(frequency);
      const double load = (stiffness - mass * frequency * frequency) * delta;
      scene::Scene scene = make_scene({.mass = mass,
                                       .stiffness = stiffness,
                                       .friction = 0.1,
                                       .restitution = 0.5,
                                       .speed = 50.0});
      test::add_rotating_force(scene, load, frequency);
      scene.initial.x = {delta};
      scene.initial.vy = {delta * frequency};
      scene.run.end = 0.2;
      // Against a force that points inward the orbit is not stable: round-off grows, and the rotor
      // leaves and returns.
      expect_orbit(scene, 1000);
    }
  }
}

// The load equals the force of the rotor's spring on the ring, so the ring carries nothing.
TEST(Orbit, AtRestOnTheRingWithoutForce) {
  for (const double load : {30.0, 70.0, 100.0 / 3.0}) {
    SCOPED_TRACE(load);
    scene::Scene scene = make_scene({.mass = 2.0, .friction = 0.1, .speed = 50.0});
    const double delta = scene.first().contact->clearance;
    scene.rotor.modal->stiffness = {load / delta};
    test::add_constant_force(scene, load * Eigen::Vector2d(0.6, -0.8));
    scene.initial.x = {0.6 * delta};
    scene.initial.y = {-0.8 * delta};
    scene.run.end = 0.2;
    expect_orbit(scene);
  }
}

}  // namespace
}  // namespace rotorub
