#include "compare/engine/continued.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

}  // namespace
}  // namespace rotorub
