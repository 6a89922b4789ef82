// Runs that go on from where another ended, and the Lyapunov exponents that are measured with
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "compare/engine/continued.h"
#include "compare/engine/lyapunov.h"
#include "native_model/run/run_native.h"
#include "tests/support/jeffcott.h"

namespace rotorub {
namespace {

// The rotor is driven into a ring on springs, bounces, and slides to the end; the motor is weak.
scene::Scene rubbing_jeffcott() {
  scene::Scene s = test::make_scene({.mass = 2.0,
                                     .damping = 40.0,
                                     .stiffness = 2e5,
                                     .friction = 0.15,
                                     .restitution = 0.5,
                                     .speed = 314.0});
  test::add_ring(s, 1.0, 200.0, 1e5);
  test::add_rotating_force(s, 150.0, 314.0, 0.3);
  s.rotor.modal->inertia = 1e-3;
  s.drive.emplace();
  s.drive->kind = scene::DriveKind::kLinear;
  s.drive->gain = 0.5;
  s.drive->speed = 314.0;
  s.forces.back().on = 1e-3;
  s.forces.back().ramp = 2e-3;
  return s;
}

Trajectory run_to(scene::Scene s, double end) {
  s.run.end = end;
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  options.output_times = {0.5 * end, end};
  return run_native(s, options);
}

TEST(Continued, IsTheSameMotionAsOneRun) {
  const scene::Scene s = rubbing_jeffcott();
  for (const double end : {4e-3, 0.02, 0.04}) {
    const Trajectory whole = run_to(s, end), half = run_to(s, 0.5 * end);
    const Trajectory rest = run_to(continued(s, s, half), 0.5 * end);
    ASSERT_EQ(whole.status, Status::kOk);
    for (const char* column : {"rotor_x", "rotor_y", "stator_x", "stator_y"})
      EXPECT_NEAR(whole.column(column).back(), rest.column(column).back(), 1e-11) << column << end;
    for (const char* column : {"rotor_vx", "stator_vy"})
      EXPECT_NEAR(whole.column(column).back(), rest.column(column).back(), 1e-8) << column << end;
    EXPECT_NEAR(whole.column("spin_speed").back(), rest.column("spin_speed").back(), 1e-7);
    EXPECT_NEAR(std::remainder(whole.column("spin_angle").back() - rest.column("spin_angle").back(),
                               2.0 * std::numbers::pi),
                0.0, 1e-9);
  }
  EXPECT_GT(run_to(s, 0.04).impacts.size(), 3u) << "it has met the ring";
}

TEST(Continued, DoesNotStartOnTheRubAgain) {
  scene::Scene s = test::make_scene({.mass = 2.0,
                                     .damping = 40.0,
                                     .stiffness = 2e4,
                                     .friction = 0.1,
                                     .restitution = 0.3,
                                     .speed = 100.0});
  test::add_ring(s, 1.0, 200.0, 1e5);
  test::add_rotating_force(s, 100.0, 100.0);
  s.initial.rub = scene::StartingRub::kSynchronous;
  const Trajectory whole = run_to(s, 0.02), half = run_to(s, 0.01);
  scene::Scene from_half = continued(s, s, half);
  EXPECT_EQ(from_half.initial.rub, scene::StartingRub::kNone);
  const Trajectory rest = run_to(from_half, 0.01);
  for (const char* column : {"rotor_x", "rotor_y", "stator_x", "stator_y"})
    EXPECT_NEAR(whole.column(column).back(), rest.column(column).back(), 1e-10) << column;
}

TEST(Continued, TakesOverASpeedThatTheNextSceneHasOfItsOwn) {
  const scene::Scene s = rubbing_jeffcott();
  const Trajectory run = run_to(s, 0.02);
  EXPECT_EQ(continued(s, s, run).rotor.speed, run.column("spin_speed").back());
  scene::Scene faster = s;
  faster.rotor.speed = 400.0;
  EXPECT_EQ(continued(faster, s, run).rotor.speed, 400.0);
}

TEST(Continued, ReportsValuesThatItCannotContinue) {
  EXPECT_EQ(not_continued(rubbing_jeffcott()), "");
  scene::Scene s = rubbing_jeffcott();
  s.first().controller.emplace().kind = scene::ControllerKind::kSliding;
  EXPECT_NE(not_continued(s), "");
  s = rubbing_jeffcott();
  s.drive->kind = scene::DriveKind::kSpeedControlled;
  EXPECT_NE(not_continued(s), "");
  s = rubbing_jeffcott();
  s.forces[0].kind = scene::ForceKind::kPulse;
  EXPECT_NE(not_continued(s), "");
}

// ---------------------------------------------------------------- exponents
// Exponents that are known: of linear rotors the real part of an eigenvalue; of a billiard in a
// circle 0, as neighbours part evenly there; of a ball that bounces in a focusing way none is
// known, but an independent one is at hand: how fast twins part.

LyapunovParameters of_event(double stretch) {
  LyapunovParameters p;
  p.stretch = stretch;
  p.integrator = scene::Integrator::kEvent;
  return p;
}

// m x'' + d x' + k x = 0: -d / 2 m, whatever drives it. From where a run has come to, its own turn
// as the stretch: of a fixed step whole steps of it. The line swings between place and speed: over
// 80 stretches by e at most.
TEST(LargestLyapunov, AfterARunIsThatOfItsScene) {
  scene::Scene s =
      test::make_scene({.mass = 2.0, .damping = 24.0, .stiffness = 2e5, .speed = 200.0});
  test::add_rotating_force(s, 20.0, 200.0);
  s.run.step = 1e-4;
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    s.run.integrator = integrator;
    const Lyapunov found = lyapunov_after(s, run_native(s, {}));
    ASSERT_TRUE(found.exponent) << found.refused;
    EXPECT_NEAR(*found.exponent, -6.0, 0.3);
    EXPECT_NEAR(found.stretch, 2.0 * std::numbers::pi / 200.0, 0.5e-4);
    if (integrator == scene::Integrator::kVerlet) {
      EXPECT_NEAR(found.stretch / 1e-4, 314.0, 1e-9);
    }
  }
  s.rotor.speed = 0.0;
  EXPECT_NE(lyapunov_after(s, run_native(s, {})).refused.find("no turns"), std::string::npos);
}

// Rotating damping d_i at Omega feeds forward whirl: the root of s^2 + (d + d_i)/m s + (k - i Omega
// d_i)/m with the greater real part.
TEST(LargestLyapunov, OfAnUnstableRotorIsItsGrowth) {
  const double m = 2.0, k = 2e5, d = 4.0, d_i = 8.0, speed = 1500.0;
  scene::Scene s = test::make_scene(
      {.mass = m, .damping = d, .stiffness = k, .clearance = 10.0, .radius = 50.0, .speed = speed});
  s.rotor.modal->internal_damping = {d_i};
  const std::complex<double> b((d + d_i) / m, 0.0), c(k / m, -speed * d_i / m);
  const auto root = std::sqrt(b * b - 4.0 * c);
  const double growth = std::max((0.5 * (-b + root)).real(), (0.5 * (-b - root)).real());
  ASSERT_GT(growth, 1.0);
  const Lyapunov found = largest_lyapunov(s, of_event(2.0 * std::numbers::pi / 316.0));
  ASSERT_TRUE(found.exponent) << found.refused;
  EXPECT_NEAR(*found.exponent / growth, 1.0, 0.02);
}

TEST(LargestLyapunov, OfACircularBilliardGoesToNothing) {
  scene::Scene s = test::make_scene({.mass = 2.0, .restitution = 1.0});
  s.initial.x = {1e-4};
  s.initial.y = {0.0};
  s.initial.vx = {0.3};
  s.initial.vy = {0.4};
  // Apart by a n + b after n stretches: ln((20 + n) / 20) / (n T) at most.
  LyapunovParameters p = of_event(3e-3);  // one impact and a half
  for (const int stretches : {80, 2000}) {
    p.stretches = stretches;
    const Lyapunov found = largest_lyapunov(s, p);
    ASSERT_TRUE(found.exponent) << found.refused;
    const double most = std::log1p(stretches / 20.0) / (stretches * p.stretch);
    EXPECT_GT(*found.exponent, 0.0);
    EXPECT_LT(*found.exponent, 1.1 * most) << stretches;
  }
}

// The start is on the ring, on which a force holds the rotor. A perturbed start inside the ring is
// invalid, so the other sense is taken.
TEST(LargestLyapunov, BeginsOnTheRingToo) {
  for (const double side : {1.0, -1.0}) {
    scene::Scene s = test::make_scene({.mass = 2.0,
                                       .damping = 40.0,
                                       .stiffness = 2e4,
                                       .friction = 0.1,
                                       .restitution = 0.3,
                                       .speed = 100.0});
    test::add_ring(s, 1.0, 200.0, 1e5);
    test::add_rotating_force(s, side * 100.0, 100.0);
    s.initial.x = {side * 0.5e-3};
    const Lyapunov found = largest_lyapunov(s, of_event(2.0 * std::numbers::pi / 100.0));
    ASSERT_TRUE(found.exponent) << found.refused;
    EXPECT_LT(*found.exponent, 0.0) << "a rub in step with its force draws its neighbours";
  }
}

TEST(LargestLyapunov, SaysWhyThereIsNone) {
  scene::Scene s = test::make_scene({.mass = 2.0, .stiffness = 2e5, .speed = 200.0});
  s.first().controller.emplace().kind = scene::ControllerKind::kSliding;
  const Lyapunov none = largest_lyapunov(s, of_event(0.03));
  EXPECT_FALSE(none.exponent);
  EXPECT_EQ(none.refused, not_continued(s));
  s = test::make_scene({.mass = 2.0, .stiffness = 2e5, .speed = 200.0});
  s.initial.rub = scene::StartingRub::kSynchronous;
  EXPECT_NE(largest_lyapunov(s, of_event(0.03)).refused.find("rub"), std::string::npos);
}

}  // namespace
}  // namespace rotorub
