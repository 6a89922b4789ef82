// Each part of a machine in a hard case: torsion, a magnetic bearing beyond the shaft's stiffness,
// a contact that jams.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;

bool has_mode(const Trajectory& t, Mode mode) {
  for (const double x : t.column("mode")) {
    if (static_cast<Mode>(x) == mode) return true;
  }
  return false;
}

// The shaft twists between the motor and a contact that alternates between stick and slip.
TEST(HardParts, TorsionInSticking) {
  for (const bool driven : {false, true}) {
    scene::Scene scene = make_scene({.mass = 2.0,
                                     .damping = 40.0,
                                     .stiffness = 2e5,
                                     .radius = 0.02,
                                     .friction = 1.5,
                                     .restitution = 0.2,
                                     .speed = 20.0});
    scene.rotor.modal->inertia = 1e-3;
    scene.rotor.torsion = scene::Torsion{0, 0.0, {1e-4}, {60.0}, {0.01}, {-0.5}};
    if (driven) {
      scene.drive = scene::Drive{};
      scene.drive->kind = scene::DriveKind::kLinear;
      scene.drive->gain = 0.5;
      scene.drive->speed = 20.0;
    }
    test::add_ring(scene, 1.0, 200.0, 1e5);
    test::add_constant_force(scene, {0.0, -150.0});
    scene.run.end = 0.3;
    const Trajectory t = test::sound_event(scene);
    EXPECT_TRUE(has_mode(t, Mode::kStick));
    EXPECT_GT(test::largest(t.column("torsion_1")), 1e-4);
    const Trajectory p = test::sound_verlet(scene);
    EXPECT_TRUE(has_mode(p, Mode::kStick));
  }
}

// Beyond the shaft's stiffness the centre is a saddle, and the ring holds the rotor.
TEST(HardParts, MagneticBearingPastTheStiffness) {
  for (const double part : {0.5, 0.999, 1.5}) {
    SCOPED_TRACE(part);
    scene::Scene scene = make_scene(
        {.mass = 2.0, .stiffness = 2e5, .friction = 0.2, .restitution = 0.4, .speed = 100.0});
    scene.magnetic_bearings = {scene::MagneticBearing{0.0, {}, part * 2e5}};
    scene.initial.x = {1e-5};
    scene.run.end = 0.1;
    const Trajectory t = test::sound_event(scene);
    if (part < 1.0) {
      const double omega = std::sqrt(2e5 * (1.0 - part) / 2.0);
      EXPECT_NEAR(t.column("rotor_x").back(), 1e-5 * std::cos(omega * 0.1), 1e-14);
    } else {
      EXPECT_GT(t.statistics.first_touch, 0.0);
    }
    const Trajectory p = test::sound_verlet(scene);
  }
}

// Masses that differ between x and y couple N and T. Under mu > (a_x + a_y) / |a_x - a_y| sliding
// one way has no force, or more than one: `event` says so. On impulses there always is a solution
// (the slip is stopped at once), and `verlet` takes it. Never NaN.
TEST(HardPainleve, SaidOnForcesSolvedOnImpulses) {
  int said = 0, solved = 0;
  for (const double mu : {0.5, 1.1, 1.5, 3.0, 10.0}) {
    for (const double speed : {-200.0, 200.0}) {
      for (const double push : {-40.0, 0.0, 40.0}) {
        SCOPED_TRACE(testing::Message() << mu << ' ' << speed << ' ' << push);
        scene::Scene scene = make_scene({.mass = 2.0,
                                         .damping = 1.0,
                                         .stiffness = 1e4,
                                         .friction = mu,
                                         .restitution = 0.0,
                                         .speed = speed});
        scene.rotor.modal->mass_y = {0.2};
        scene.rotor.modal->stiffness_y = {1e4};
        scene.rotor.modal->damping_y = {1.0};
        const double h = 0.5e-3 * std::sqrt(0.5);
        scene.initial.x = scene.initial.y = {h};  // at 45 degrees, where G_NT is largest
        test::add_constant_force(scene, {push, push});
        scene.run.end = 0.02;
        const bool can_jam = mu > (1.0 / 0.2 + 1.0 / 2.0) / (1.0 / 0.2 - 1.0 / 2.0);
        const Trajectory t = test::attempt_event(scene), p = test::run_verlet(scene, 1e-5);
        for (const Trajectory* run : {&t, &p}) {
          test::expect_refused_or_finite(*run);
          test::expect_dissipative_impacts(scene, *run);
          if (run->status == Status::kOk) continue;
          EXPECT_TRUE(can_jam);
          EXPECT_TRUE(run->status == Status::kNoSolution || run->status == Status::kAmbiguous);
          EXPECT_NE(run->message.find("Painleve"), std::string::npos) << run->message;
          EXPECT_LT(run->end, scene.run.end);
        }
        if (t.status == Status::kOk) test::expect_sound_event(scene, t);
        said += t.status == Status::kOk ? 0 : 1;
        solved += t.status == Status::kOk ? 1 : 0;
      }
    }
  }
  EXPECT_GT(said, 0);
  EXPECT_GT(solved, 10);
}

}  // namespace
}  // namespace rotorub
