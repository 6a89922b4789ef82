// Two rings on one shaft: one coupled problem.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kPairStep = 1e-5, kPairSpeed = 0.3, kPairEps = 0.5, kShaft = 2.0;
enum ShaftCoordinate { kShaftX, kShaftY, kTiltX, kTiltY, kShaftSpin };

class Pairs : public HookedTest {
 protected:
  // Kinetic energy of the velocities, at their own pose and at the pose with which the last step
  // began.
  static double energy(const mjModel* m, mjData* d) {
    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_crb(m, d);
    return energy_of_step(m, d);
  }
  static double energy_of_step(const mjModel* m, mjData* d) {
    std::vector<mjtNum> momentum(static_cast<std::size_t>(m->nv));
    mj_mulM(m, d, momentum.data(), d->qvel);
    return 0.5 * mju_dot(momentum.data(), d->qvel, m->nv);
  }
  // How far the disc of a contact is outside its ring, m.
  static double depth(const mjModel* m, const mjData* d, const char* disc, const char* ring,
                      double clearance) {
    const mjtNum* a = d->geom_xpos + 3 * mj_name2id(m, mjOBJ_GEOM, disc);
    const mjtNum* b = d->geom_xpos + 3 * mj_name2id(m, mjOBJ_GEOM, ring);
    return std::hypot(a[0] - b[0], a[1] - b[1]) - clearance;
  }
};

// A central hit: each ring takes half, and nothing tilts. With tilt the impulses are unique;
// without, they are shared equally.
TEST_F(Pairs, ACentralHitDoesNotTilt) {
  for (const bool tilts : {true, false}) {
    TwoRings x;
    x.tilts = tilts;
    const ModelPointer m = load(document(x));
    const DataPointer d = start(m.get());
    d->qpos[kShaftX] = 4.99e-4;
    d->qvel[kShaftX] = kPairSpeed;
    mj_step(m.get(), d.get());
    EXPECT_NEAR(d->qvel[kShaftX], -kPairEps * kPairSpeed, 1e-12);
    for (int i = 1; i < m->nv; ++i) EXPECT_NEAR(d->qvel[i], 0.0, 1e-12) << i;
    const double each = 0.5 * (1.0 + kPairEps) * kPairSpeed * kShaft / kPairStep;
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), each, 1e-9 * each);
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force_2"), each, 1e-9 * each);
  }
}

// Two rings of 1 kg equal one of 2 kg, through blows, sliding and sticking.
TEST_F(Pairs, TwoRingsAreOneOfTwiceTheMass) {
  for (const char* contact : {"rigid", "coulomb"}) {
    TwoRings two;
    two.contact = contact;
    two.friction = 0.15;
    two.ring_mass = 1.0;
    TwoRings one = two;
    one.rings = 1;
    one.ring_mass = 2.0;
    const ModelPointer a = load(document(two)), b = load(document(one));
    const DataPointer d = start(a.get()), e = start(b.get());
    for (mjData* data : {d.get(), e.get()}) {
      data->qvel[kShaftX] = kPairSpeed;
      data->qvel[kShaftY] = 0.1;
      data->qvel[kShaftSpin] = 100.0;
      data->qfrc_applied[kShaftX] = 200.0;
    }
    for (int k = 0; k < 4000; ++k) {
      mj_step(a.get(), d.get());
      mj_step(b.get(), e.get());
      const bool soft = contact[0] == 'c';  // each contact has MuJoCo's softness to itself
      ASSERT_NEAR(d->qpos[kShaftX], e->qpos[kShaftX], soft ? 2e-5 : 1e-9) << contact << k;
      ASSERT_NEAR(d->qpos[kTiltY], 0.0, 1e-9) << contact << k;
    }
    EXPECT_NEAR(d->qvel[kShaftSpin], e->qvel[kShaftSpin],
                1e-3 * std::abs(100.0 - e->qvel[kShaftSpin]));
    EXPECT_LT(d->qvel[kShaftSpin], 99.0);
    const double normal = sensor(b.get(), e.get(), "normal_force");
    ASSERT_GT(normal, 10.0);
    EXPECT_NEAR(sensor(a.get(), d.get(), "normal_force"), 0.5 * normal, 1e-3 * normal) << contact;
    EXPECT_NEAR(sensor(a.get(), d.get(), "normal_force_2"), 0.5 * normal, 1e-3 * normal) << contact;
  }
}

// By hand: the ring at one end strikes, the other is away. G_NN = 1 / m + z^2 / J.
TEST_F(Pairs, ABlowAtOneEndIsThatOfOneRing) {
  TwoRings x;
  x.clearance[1] = 1e-2;
  const ModelPointer m = load(document(x));
  const DataPointer d = start(m.get());
  d->qpos[kShaftX] = 4.99e-4;
  d->qvel[kShaftX] = kPairSpeed;
  mj_step(m.get(), d.get());
  const double impulse = (1.0 + kPairEps) * kPairSpeed / (1.0 / kShaft + 0.01 / 0.02);
  EXPECT_NEAR(d->qvel[kShaftX], kPairSpeed - impulse / kShaft, 1e-9);
  EXPECT_NEAR(std::abs(d->qvel[kTiltY]), 0.1 * impulse / 0.02, 1e-9);
  EXPECT_EQ(sensor(m.get(), d.get(), "normal_force_2"), 0.0);
}

// A blow at one end drives the other end out: both are in one step.
TEST_F(Pairs, AnEndThatIsDrivenIntoItsRingIsCaught) {
  TwoRings x;
  x.restitution = 1.0;
  x.friction = 0.1;
  const ModelPointer m = load(document(x));
  for (double depth_left = 1e-9; depth_left < 1e-6; depth_left *= 3.0) {
    const DataPointer d = start(m.get());
    // The end at -0.1 at its ring in +x, the other at its ring in -x, the shaft tilted.
    d->qpos[kTiltY] = -(5e-4 - depth_left) / 0.1;
    d->qvel[kShaftX] = kPairSpeed;
    d->qvel[kTiltY] = -2.9;
    d->qvel[kShaftSpin] = 50.0;
    const double before = energy(m.get(), d.get());
    mj_step(m.get(), d.get());
    mj_kinematics(m.get(), d.get());
    EXPECT_LT(depth(m.get(), d.get(), "disc", "ring", 5e-4), 1e-9) << depth_left;
    EXPECT_LT(depth(m.get(), d.get(), "far", "holder", 5e-4), 1e-9) << depth_left;
    EXPECT_LT(energy(m.get(), d.get()), before * (1.0 + 1e-9)) << depth_left;
  }
}

// A rotor thrown at random: no contact adds energy, and the rotor stays in the rings.
TEST_F(Pairs, RandomFlightsStayInTheirRings) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const char* contact : {"rigid", "coulomb"}) {
    TwoRings x;
    x.contact = contact;
    x.friction = 0.02;  // less than what would set it rolling, at 5000 rad/s: too fast for the step
    x.ring_mass = 1.5;
    x.clearance[1] = 3e-4;
    const bool soft = contact[0] == 'c';
    const ModelPointer m = load(document(x)), without = load(document(x));
    without->opt.disableflags |= mjDSBL_CONTACT;
    const DataPointer flies = start(without.get());
    for (int k = 0; k < 6; ++k) {
      const DataPointer d = start(m.get());
      for (int i = 0; i < 2; ++i) d->qvel[i] = 0.5 * unit(random);
      for (int i = kTiltX; i <= kTiltY; ++i) d->qvel[i] = 5.0 * unit(random);
      d->qvel[kShaftSpin] = 200.0 * unit(random);
      for (int i = kShaftSpin + 1; i < m->nv; ++i) d->qvel[i] = 0.2 * unit(random);
      for (int n = 0; n < 1500; ++n) {
        if (!soft) mj_copyData(flies.get(), without.get(), d.get());
        mj_step(m.get(), d.get());
        ASSERT_LT(depth(m.get(), d.get(), "disc", "ring", 5e-4), soft ? 5e-5 : 1e-6)
            << k << " " << n;
        ASSERT_LT(depth(m.get(), d.get(), "far", "holder", 3e-4), soft ? 5e-5 : 1e-6)
            << k << " " << n;
        if (soft) continue;
        // The step that is taken and the one without contact, both with the masses of its pose. (A
        // depth of nanometres is undone by a fifth a step.)
        mj_step(without.get(), flies.get());
        const double free = energy_of_step(without.get(), flies.get());
        ASSERT_LT(energy_of_step(m.get(), d.get()), free * (1.0 + 1e-6)) << k << " " << n;
      }
    }
  }
}

// With a constraint of MuJoCo's solver: tied to 200 kg, the shaft strikes both rings with it.
TEST_F(Pairs, ConstraintsAreSolvedTogetherWithBoth) {
  TwoRings x;
  x.friction = 0.15;
  x.bodies =
      R"(<body name="base"><freejoint/><inertial pos="0 0 0" mass="200" diaginertia="9 9 9"/></body>)";
  x.constraints =
      "<equality><weld body1=\"shaft\" body2=\"base\" solimp=\"0.9999 0.9999 0.001\"/></equality>";
  x.ring_mass = 1.0;
  const ModelPointer m = load(document(x));
  const DataPointer d = start(m.get());
  d->qpos[kShaftX] = 4.99e-4;
  d->qvel[kShaftX] = d->qvel[kShaftSpin + 1 + 4] = kPairSpeed;
  mj_step(m.get(), d.get());
  const double whole = kShaft + 200.0;
  const double impulse = (1.0 + kPairEps) * kPairSpeed / (1.0 / whole + 1.0 / 2.0);
  EXPECT_NEAR(d->qvel[kShaftX], kPairSpeed - impulse / whole, 3e-4 * kPairSpeed);
  EXPECT_NEAR(d->qvel[kShaftSpin + 1], impulse / 2.0, 3e-4 * kPairSpeed);
  EXPECT_NEAR(d->qvel[kShaftSpin + 3], impulse / 2.0, 3e-4 * kPairSpeed);
  EXPECT_NEAR(d->qvel[kTiltY], 0.0, 1e-6);
  EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), sensor(m.get(), d.get(), "normal_force_2"),
              1e-6 * impulse / kPairStep);
}

// A lasting contact at one end takes part in the blow at the other.
TEST_F(Pairs, ALastingContactTakesPartInABlow) {
  TwoRings x;
  x.restitution = 0.5;
  const ModelPointer m = load(document(x));
  const DataPointer d = start(m.get());
  // The near end lies pressed in its ring, the other comes down on its own.
  d->qpos[kShaftX] = 5e-4;
  d->qpos[kTiltY] = 0.0;
  const auto press = [&](double force) { d->qfrc_applied[kShaftX] = force; };
  press(50.0);
  for (int k = 0; k < 200; ++k) mj_step(m.get(), d.get());
  EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 25.0, 1e-3);
  EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force_2"), 25.0, 1e-3);
  // Turned about the near end, which stays: the far end off by 1 um and coming at 0.2 m/s.
  d->qpos[kTiltY] = -5e-6;
  d->qpos[kShaftX] = 5e-4 - 5e-7;
  d->qvel[kTiltY] = 1.0;
  d->qvel[kShaftX] = 0.1;
  const double before = energy(m.get(), d.get());
  mj_step(m.get(), d.get());
  mj_kinematics(m.get(), d.get());
  EXPECT_LT(energy(m.get(), d.get()), before);
  EXPECT_LT(depth(m.get(), d.get(), "disc", "ring", 5e-4), 1e-9);
  EXPECT_LT(depth(m.get(), d.get(), "far", "holder", 5e-4), 1e-9);
  EXPECT_GT(sensor(m.get(), d.get(), "normal_force_2"), 100.0);
}

}  // namespace
}  // namespace rotorub::test
