// A rotor that moves along the axis of its ring: friction in both directions of the tangent plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "plugin/config_cache.h"
#include "plugin/contact/contact_memory.h"
#include "tests/plugin/own/lift.h"

namespace rotorub::test {
namespace {

TEST_F(Axial, FallsWithItsWeightLessFriction) {
  Lift x;
  x.friction = 0.1;
  const ModelPointer m = load(document(x));
  const DataPointer d = pressed(m.get());
  run(m.get(), d.get(), 0.1);
  EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -0.1 * (kWeight - 10.0) / kLiftMass, 1e-12);
  EXPECT_EQ(sensor(m.get(), d.get(), "rotorub_active"), 1.0);
  EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 100.0, 1e-9);
  EXPECT_NEAR(sensor(m.get(), d.get(), "friction_force"), 0.0, 1e-9);  // none along the ring
}

// Normal force by MuJoCo's solver, friction beside it.
TEST_F(Axial, CoulombHasBothDirectionsToo) {
  for (const double mu : {0.1, 0.5}) {
    Lift x;
    x.friction = mu;
    x.contact = "coulomb";
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get(), mu == 0.1 ? 0.0 : -0.2);
    run(m.get(), d.get(), 0.1);
    const double speed = mu == 0.1 ? -0.1 * (kWeight - 10.0) / kLiftMass : 0.0;
    EXPECT_NEAR(of(m.get(), d->qvel, "lift"), speed, 1e-5) << mu;
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 100.0, 1e-3) << mu;
    if (mu == 0.1) continue;
    EXPECT_LT(std::abs(of(m.get(), d->qvel, "lift")), 1e-12);
  }
  Lift x = held_across();
  x.contact = "coulomb";
  const ModelPointer m = load(document(x));
  const DataPointer d = pressed(m.get(), 4.0, 3.0 / kLiftRadius);
  of(m.get(), d->qfrc_applied, "lift") = 0.0;
  run(m.get(), d.get(), 0.02);
  const double left = 1.0 - 0.02 * 50.0 / kLiftMass / 5.0;
  EXPECT_NEAR(of(m.get(), d->qvel, "lift"), 4.0 * left, 1e-4);
  EXPECT_NEAR(of(m.get(), d->qvel, "spin") * kLiftRadius, 3.0 * left, 1e-4);
  EXPECT_NEAR(sensor(m.get(), d.get(), "friction_force"), -30.0, 1e-2);
}

// MuJoCo's own cone has both directions in the frame of its contact. Its friction reference lets a
// sliding contact hop; on average it brakes as it should.
TEST_F(Axial, AsMujocosCone) {
  for (const double mu : {0.1, 0.5}) {
    Lift x;
    x.friction = mu;
    x.contact = "cone";
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get());
    int sliding = 0, closed = 0;
    for (int i = 0; i < 10000; ++i) {
      mj_step(m.get(), d.get());
      const ContactMode mode =
          plugin::contact_forces(*plugin::find_config(m.get(), d.get()), m.get(), d.get()).mode;
      closed += mode == ContactMode::kFree ? 0 : 1;
      sliding += mode == ContactMode::kSlide ? 1 : 0;
    }
    const double speed = mu == 0.1 ? -0.1 * (kWeight - 10.0) / kLiftMass : 0.0;
    EXPECT_NEAR(of(m.get(), d->qvel, "lift"), speed, 5e-3) << mu;
    EXPECT_NEAR(sensor(m.get(), d.get(), "friction_force"), 0.0, 1e-9) << mu;
    EXPECT_GT(closed, 100);
    if (mu == 0.1) {
      EXPECT_GT(sliding, 9 * closed / 10);  // though it does not slip round the ring
      continue;
    }
    EXPECT_LT(sliding, closed / 10);
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 100.0, 1e-2);
    ASSERT_EQ(d->ncon, 1);
    EXPECT_NEAR(std::abs(d->efc_force[d->contact[0].efc_address + 2]), kWeight, 1e-2);
  }
}

// A pair with one value of friction has MuJoCo's default, 1, for the second.
TEST_F(Axial, TheConesTwoFrictionsAreHeldAgainstTheText) {
  Lift x;
  x.contact = "cone";
  expect_refused(replaced(document(x), "friction=\"0.5 0.5\"", "friction=\"0.5\""),
                 "friction along the axis, the second value, is 1");
}

// mu N = 50 N exceeds the weight: it brakes with the difference, and then stands without creeping.
TEST_F(Axial, StopsAndSticksUnderItsWeight) {
  const ModelPointer m = load(document(Lift{}));
  const DataPointer d = pressed(m.get(), -1.0);
  const double braking = (50.0 - kWeight) / kLiftMass;
  double &speed = of(m.get(), d->qvel, "lift"), &height = of(m.get(), d->qpos, "lift");
  run(m.get(), d.get(), 0.05);
  EXPECT_NEAR(speed, -1.0 + 0.05 * braking, 1e-12);
  run(m.get(), d.get(), 0.05);
  EXPECT_LT(std::abs(speed), 1e-15);
  const double where = height;
  EXPECT_NEAR(where, -0.5 / braking, 1e-5);
  run(m.get(), d.get(), 0.1);
  EXPECT_LT(std::abs(height - where), 1e-14);
}

// With equal inertia around and along its axis, J = m r^2, the slip keeps its direction and falls
// by mu N / m.
TEST_F(Axial, FrictionIsSharedAsTheSlipIs) {
  const ModelPointer m = load(document(held_across()));
  const DataPointer d = pressed(m.get(), 4.0, 3.0 / kLiftRadius);
  of(m.get(), d->qfrc_applied, "lift") = 0.0;
  run(m.get(), d.get(), 0.1);
  const double left = 1.0 - 0.1 * 50.0 / kLiftMass / 5.0;
  constexpr double kManySteps = 1e-11;  // m/s, round-off of 10,000
  EXPECT_NEAR(of(m.get(), d->qvel, "lift"), 4.0 * left, kManySteps);
  EXPECT_NEAR(of(m.get(), d->qvel, "spin") * kLiftRadius, 3.0 * left, kManySteps);
  EXPECT_NEAR(sensor(m.get(), d.get(), "friction_force"), -30.0, 1e-9);
}

// ---------------------------------------------------------------- blows
// Blows with friction along the axis; several contacts, rings that move and constraints beside it.

// A ball on a free joint strikes obliquely: sliding and, with more friction, sticking; closed form
// of a mobility 1/m + r^2/J in both directions.
TEST_F(Axial, AnObliqueBlowOfABall) {
  for (const double mu : {0.1, 2.0}) {
    Lift x;
    x.joints = "<freejoint/>";
    x.inertia = 2e-3;
    x.friction = mu;
    x.restitution = 0.5;
    const ModelPointer m = load(document(x));
    const DataPointer d = start(m.get());
    const std::array<double, 6> v{1.0, 2.0, -1.5, 3.0, 8.0, 10.0};
    d->qpos[0] = kPlay - 0.5 * kLiftStep;
    std::copy(v.begin(), v.end(), d->qvel);
    mj_step(m.get(), d.get());
    const double r = kLiftRadius, normal = 1.5 * kLiftMass;
    const double around = v[1] + r * v[5], along = v[2] - r * v[4],
                 slip = std::hypot(around, along);
    const double friction = std::min(mu * normal, slip / (1.0 / kLiftMass + r * r / x.inertia));
    const double t = -friction * around / slip, z = -friction * along / slip;
    EXPECT_NEAR(d->qvel[0], -0.5, 1e-12);
    EXPECT_NEAR(d->qvel[1], v[1] + t / kLiftMass, 1e-12) << mu;
    EXPECT_NEAR(d->qvel[2], v[2] + z / kLiftMass, 1e-12) << mu;
    EXPECT_NEAR(d->qvel[3], v[3], 1e-12) << mu;
    EXPECT_NEAR(d->qvel[4], v[4] - r * z / x.inertia, 1e-12) << mu;
    EXPECT_NEAR(d->qvel[5], v[5] + r * t / x.inertia, 1e-12) << mu;
  }
}

TEST_F(Axial, ATurnedMachineMovesAlike) {
  Lift x;
  x.friction = 0.3;
  x.restitution = 0.5;
  const auto end = [&](const std::string& turn) {
    x.turn = turn;
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get(), 0.7, 30.0);
    of(m.get(), d->qpos, "press") = 0.0;
    run(m.get(), d.get(), 0.05);
    return state_of(m.get(), d.get());
  };
  const std::vector<double> upright = end("1 0 0 0"), turned = end("0.5 -0.7 0.3 0.41");
  for (std::size_t i = 0; i < upright.size(); ++i) {
    EXPECT_NEAR(turned[i], upright[i], 1e-9 * (1.0 + std::abs(upright[i]))) << i;
  }
}

// A shaft on a free joint in two rings 2 a apart, pressed in the middle: it slides down with m g -
// mu N, and the rings bear unlike shares, as friction acts beside the middle: N = N_0 / 2 (1 +- mu
// r / a).
TEST_F(Axial, AShaftInTwoRings) {
  TwoRings x;
  x.friction = 0.15;
  std::string text = document(x);
  for (const char* axis : {"1 0 0", "0 1 0"})
    text = replaced(text, std::string("<joint type=\"hinge\" axis=\"") + axis + "\"/>", "");
  text =
      replaced(text, R"(<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>)", "");
  text = replaced(text, R"(<joint type="hinge" axis="0 0 1"/>)", "<freejoint/>");
  const ModelPointer m = load(text);
  const DataPointer d = start(m.get());
  d->qpos[0] = kPlay;
  d->qfrc_applied[0] = 100.0;
  d->qfrc_applied[2] = -kWeight;
  run(m.get(), d.get(), 1e-3);
  EXPECT_NEAR(d->qvel[2], -1e-3 * (kWeight - 15.0) / kLiftMass, 1e-9);
  const double one = sensor(m.get(), d.get(), "normal_force"),
               two = sensor(m.get(), d.get(), "normal_force_2");
  EXPECT_NEAR(one + two, 100.0, 1e-6);
  EXPECT_NEAR(std::abs(one - two), 100.0 * 0.15 * 0.5, 1e-4);
}

// Instead the ring moves, on a damper: friction takes from the rotor what it gives to the ring. At
// the end the ring falls no faster than its damper allows, c v = mu N.
TEST_F(Axial, ARingThatIsDraggedAlong) {
  Lift x;
  x.friction = 0.1;
  x.joints =
      R"(<joint name="press" type="slide" axis="1 0 0"/><joint name="spin" type="hinge" axis="0 0 1"/>
      <joint name="lift" type="slide" axis="0 0 1"/>)";
  const std::string text =
      replaced(document(x), R"(<geom name="bore")",
               R"(<body name="holder"><joint name="ring" type="slide" axis="0 0 1" damping="20"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/><geom name="bore")");
  const ModelPointer m = load(replaced(text, "size=\"0.0505\"/>", "size=\"0.0505\"/></body>"));
  const DataPointer d = pressed(m.get(), -1.0);
  run(m.get(), d.get(), 0.01);
  const double first = 1.0 - std::exp(-20.0 * 0.01);  // of 1 kg on 20 N s/m
  EXPECT_NEAR(of(m.get(), d->qvel, "ring"), -0.5 * first, 1e-4);
  EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -1.0 - 0.01 * (kWeight - 10.0) / kLiftMass, 1e-12);
  run(m.get(), d.get(), 1.0);
  EXPECT_NEAR(of(m.get(), d->qvel, "ring"), -0.5, 1e-8);
}

// The contact model depends on the machine, not on its names: the same document with another axis.
TEST_F(Axial, ModelsThatDifferInAnAxisAlone) {
  const std::string lifts = document(Lift{}),
                    stays = replaced(lifts, "name=\"lift\" type=\"slide\" axis=\"0 0 1\"",
                                     "name=\"lift\" type=\"slide\" axis=\"0 1 0\"");
  for (const std::string* text : {&stays, &lifts, &stays}) {
    const ModelPointer m = load(*text);
    const DataPointer d = pressed(m.get(), -1.0);
    run(m.get(), d.get(), 1e-3);
    const double friction = sensor(m.get(), d.get(), "friction_force");
    if (text == &lifts) {
      EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -1.0 + 1e-3 * (50.0 - kWeight) / kLiftMass, 1e-12);
    } else {
      EXPECT_GT(std::abs(friction), 10.0);
    }
  }
}

// It is tied along its axis to 3 kg, so friction brakes both.
TEST_F(Axial, BesideAConstraint) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Lift x;
    x.friction = 0.1;
    x.contact = contact;
    x.bodies = R"(<body name="weight" pos="1 0 0"><joint name="weight" type="slide" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="3" diaginertia="1 1 1"/></body>)";
    x.more = equality("<joint joint1=\"lift\" joint2=\"weight\"" + kHard + "/>");
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get());
    run(m.get(), d.get(), 0.1);
    EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -0.1 * (kWeight - 10.0) / 5.0, 1e-3) << contact;
  }
}

}  // namespace
}  // namespace rotorub::test
