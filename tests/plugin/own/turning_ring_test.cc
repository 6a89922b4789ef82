// A user's ring that turns (an auxiliary ball bearing): a hinge about the ring's axis with inertia
// and drag, by itself or beside slides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mjcf/names.h"
#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kTurningRadius = 0.05, kTurningClearance = 5e-4,
                 kBore = kTurningRadius + kTurningClearance, kMu = 0.15;
constexpr double kWhirl = 0.4, kRingSpeed = 314.0, kRotorSpeed = 100.0;

class OwnTurningRing : public HookedTest {
 protected:
  // Held at its centre, so that it can do nothing but turn, around a rotor whose spin hardly
  // changes.
  enum Held { kX, kY, kSpin, kRing };
  static constexpr double kHeldInertia = 2e-3, kDrag = 4e-3, kRotorInertia = 100.0 + 1e-3;
  static ModelPointer held(const std::string& contact, double friction, double drag) {
    Machine x;
    x.contact = contact;
    x.friction = friction;
    x.spin = "armature=\"100\"";
    x.ring_moves = false;
    x.ring_geoms =
        "<joint name=\"turn\" type=\"hinge\" axis=\"0 0 1\" armature=\"1e-3\" damping=\"" +
        std::to_string(drag) + "\"/>";
    return load(document(x));
  }

  // Rotor and ring float; the rotor circles in the ring's bore, where the normal force is known:
  // m w^2 / delta_0, m the reduced mass.
  static ModelPointer floating(const std::string& contact, double friction) {
    Machine x;
    x.contact = contact;
    x.friction = friction;
    x.ring_geoms = R"(<joint name="turn" type="hinge" axis="0 0 1" damping="2e-3"/>)";
    return load(document(x));
  }
  static DataPointer begin(const mjModel* m) {
    DataPointer d = start(m);
    d->qpos[0] = kTurningClearance;
    d->qvel[1] = kWhirl;
    d->qvel[2] = kRotorSpeed;
    d->qvel[5] = kRingSpeed;
    return d;
  }
};

// ---------------------------------------------------------------- held at its centre
// Pressed against the ring by a load that turns with the rub's normal: at rest at angle 0, held by
// y = 0. Omega_r(t) = (mu N R / c_r) (1 - exp(-c_r t / J_r)), R = r + delta_0, while it slips.
TEST_F(OwnTurningRing, IsSpunUpByTheRub) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = held(contact, kMu, kDrag);
    const DataPointer d = start(m.get());
    d->qpos[kX] = kTurningClearance;
    d->qvel[kSpin] = 1000.0;
    constexpr double kForce = 100.0;
    constexpr int kSteps = 40000;
    double worst = 0.0, lowest = 1e9, highest = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      d->qfrc_applied[kX] = kForce;
      d->qfrc_applied[kY] = kMu * kForce;  // what friction pulls, so that it stays
      mj_step(m.get(), d.get());
      if (k < 200) continue;
      const double normal = sensor(m.get(), d.get(), "normal_force");
      lowest = std::min(lowest, normal);
      highest = std::max(highest, normal);
      const double t = d->time;
      const double speed =
          kMu * kForce * kBore / kDrag * (1.0 - std::exp(-kDrag * t / kHeldInertia));
      worst = std::max(worst, std::abs(d->qvel[kRing] - speed));
    }
    EXPECT_GT(d->qvel[kRing], 90.0) << contact;
    EXPECT_LT(worst, 1e-3 * d->qvel[kRing]) << contact;
    EXPECT_NEAR(lowest, kForce, 0.02 * kForce) << contact;
    EXPECT_NEAR(highest, kForce, 0.02 * kForce) << contact;
    EXPECT_NEAR(sensor(m.get(), d.get(), "slip"),
                d->qvel[kY] + kTurningRadius * d->qvel[kSpin] - kBore * d->qvel[kRing], 1e-3)
        << contact;
  }
}

// Impacts with friction on a ring that turns conserve the angular momentum about the ring's axis.
TEST_F(OwnTurningRing, AngularMomentumIsConserved) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = held(contact, 0.3, 0.0);
    const DataPointer d = start(m.get());
    d->qvel[kX] = 0.3;
    d->qvel[kY] = 0.2;
    d->qvel[kSpin] = 20.0;
    d->qvel[kRing] = 314.0;
    const auto momentum = [&] {
      return 2.0 * (d->qpos[kX] * d->qvel[kY] - d->qpos[kY] * d->qvel[kX]) +
             kRotorInertia * d->qvel[kSpin] + kHeldInertia * d->qvel[kRing];
    };
    const double before = momentum();
    for (int k = 0; k < 20000; ++k) mj_step(m.get(), d.get());
    EXPECT_LT(d->qvel[kRing], 310.0) << contact;
    // The exchanged angular momentum is about 0.1 N m s.
    EXPECT_NEAR(momentum(), before, contact[0] == 'r' ? 1e-10 : 1e-6) << contact;
  }
}

// ---------------------------------------------------------------- floating
TEST_F(OwnTurningRing, WithoutFrictionItsTurningGivesTheRotorNoForce) {
  constexpr double kReducedMass = 2.0 / 3.0;
  const double exact = kReducedMass * kWhirl * kWhirl / kTurningClearance;
  for (const std::string contact : {"rigid", "coulomb"}) {
    const ModelPointer m = floating(contact, 0.0);
    const DataPointer d = begin(m.get());
    for (int k = 0; k < 2000; ++k) {
      mj_step(m.get(), d.get());
      if (k < 100) continue;  // until the soft contact has found its depth
      ASSERT_NEAR(sensor(m.get(), d.get(), mjcf_names::kNormalForce), exact, 1e-3 * exact)
          << contact << ", step " << k;
    }
  }
}

}  // namespace
}  // namespace rotorub::test
