// Starts in a compliant contact. One that begins closed is loaded and not struck, so that its
// damping, which follows from the restitution and the speed of a touch, is 0.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using scene::Integrator;

constexpr double kBody = 2.0, kWall = 2e7, kRing = 0.5e-3;  // kg, N/m, m
constexpr double kStartStep = 1e-6;                         // s
constexpr Integrator kStarters[] = {Integrator::kEvent, Integrator::kVerlet};

// Relative error that a step may cause: sqrt(k/m) step = 3e-3.
double missed(Integrator engine) { return engine == Integrator::kEvent ? 1e-9 : 1e-4; }

// At a depth (m), in a direction (rad), at a speed outward (m/s).
scene::Scene starting(double depth, double angle, double speed) {
  scene::Scene s = test::make_scene({.mass = kBody, .clearance = kRing, .restitution = 0.5});
  s.first().contact->compliance = Compliance{.stiffness = kWall};
  s.initial.x = {(kRing + depth) * std::cos(angle)};
  s.initial.y = {(kRing + depth) * std::sin(angle)};
  s.initial.vx = {speed * std::cos(angle)};
  s.initial.vy = {speed * std::sin(angle)};
  s.run.end = 1.2e-3;  // more than half a period of the mass on the spring, 1.0 ms
  s.run.step = kStartStep;
  return s;
}

// It leaves with all its energy: v^2 = v_0^2 + k p_0^2 / m, 0.05244 m/s.
TEST(CompliantStart, InTheWallItKeepsItsEnergy) {
  const double depth = 5e-6, speed = 0.05;
  const double leaves = std::sqrt(speed * speed + kWall / kBody * depth * depth);
  for (const double angle : {0.0, 0.7, 2.5}) {
    for (const double way : {1.0, -1.0}) {
      for (const Integrator engine : kStarters) {
        const Trajectory t =
            test::run_with(starting(depth, angle, way * speed), engine, kStartStep);
        EXPECT_NEAR(std::hypot(t.column("rotor_vx").back(), t.column("rotor_vy").back()) / leaves,
                    1.0, missed(engine))
            << angle << " " << way << " " << static_cast<int>(engine);
      }
    }
  }
}

// At rest on the circle under a force F: 2 F / k deep, 30 um, wherever round-off puts the circle.
TEST(CompliantStart, OnTheCircleAtRestItIsLoaded) {
  const double force = 300.0;
  for (const double angle : {0.0, 0.7, 2.5}) {
    for (const Integrator engine : kStarters) {
      scene::Scene s = starting(0.0, angle, 0.0);
      test::add_constant_force(s, force * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      const Trajectory t = test::run_with(s, engine, kStartStep);
      EXPECT_NEAR(t.statistics.max_penetration / (2.0 * force / kWall), 1.0, missed(engine))
          << angle << " " << static_cast<int>(engine);
    }
  }
}

// A contact that closes on the circle has the speed of a touch, and rebounds with the restitution.
TEST(CompliantStart, OnTheCircleAtASpeedItIsStruck) {
  for (const Integrator engine : kStarters) {
    const Trajectory t = test::run_with(starting(0.0, 0.7, 0.3), engine, kStartStep);
    EXPECT_NEAR(std::hypot(t.column("rotor_vx").back(), t.column("rotor_vy").back()) / 0.15, 1.0,
                engine == Integrator::kEvent ? 1e-8 : 1e-3)
        << static_cast<int>(engine);
  }
}

}  // namespace
}  // namespace rotorub
