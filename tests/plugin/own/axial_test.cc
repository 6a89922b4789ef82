// A rotor that moves along the axis of its ring: friction in both directions of the tangent plane.
#include <gtest/gtest.h>

#include <cmath>

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
// contact that slides hop; on the mean it brakes as it should.
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
      const Mode mode =
          plugin::contact_forces(*plugin::find_config(m.get(), d.get()), m.get(), d.get()).mode;
      closed += mode == Mode::kFree ? 0 : 1;
      sliding += mode == Mode::kSlide ? 1 : 0;
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

// A pair that has one value of friction has MuJoCo's default, 1, for the second.
TEST_F(Axial, TheConesTwoFrictionsAreHeldAgainstTheText) {
  Lift x;
  x.contact = "cone";
  expect_refused(replaced(document(x), "friction=\"0.5 0.5\"", "friction=\"0.5\""),
                 "friction along the axis, the second value, is 1");
}

// mu N = 50 N is beyond the weight: it brakes with the difference, and then stands, not creeping.
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

// As heavy round its axis as along it, J = m r^2: the slip keeps its direction and falls by mu N /
// m.
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

}  // namespace
}  // namespace rotorub::test
