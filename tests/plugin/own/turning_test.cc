// A ring that turns (an auxiliary ball bearing): a hinge about its axis, with inertia and drag, in a
// user's own model.
#include <gtest/gtest.h>

#include <cmath>

#include "plugin/hooks.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kRadius = 0.05, kClearance = 5e-4, kMu = 0.15;
constexpr double kRingInertia = 2e-3, kDrag = 4e-3;
enum Coordinate { kX, kY, kSpin, kRing };

std::string document(const std::string& contact, double friction, double drag, double restitution) {
  const std::string pair =
      contact == "rigid"
          ? "condim=\"1\" margin=\"5e-6\" gap=\"1\""
          : "condim=\"1\" solref=\"-4e8 -10211.0255\" solimp=\"0.9999 0.9999 0.001\" margin=\"5e-7\"";
  return R"(<mujoco><option timestep="1e-5" gravity="0 0 0" collision="predefined"/>
  <size nuserdata="32"/>
  <worldbody>
    <body name="rotor">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
      <joint type="hinge" axis="0 0 1" armature="100"/>
      <inertial pos="0 0 0" mass="2" diaginertia="1e-3 1e-3 1e-3"/>
      <geom name="disc" type="cylinder" size="0.05 0.01"/>
    </body>
    <body name="ring">
      <joint type="hinge" axis="0 0 1" damping=")" + std::to_string(drag) + R"("/>
      <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 2e-3"/>
      <geom name="bore" type="cylinder" size="0.06 0.01"/>
    </body>
  </worldbody>
  <contact><pair geom1="disc" geom2="bore" )" + pair + R"(/></contact>
  <sensor>
    <user name="normal_force" objtype="body" objname="rotor" datatype="real" needstage="pos" dim="1"/>
    <user name="slip" objtype="body" objname="rotor" datatype="real" needstage="pos" dim="1"/>
    <user name="gap" objtype="body" objname="rotor" datatype="real" needstage="acc" dim="1"/>
  </sensor>
  <custom>
    <text name="rotorub_rotor_geom" data="disc"/><text name="rotorub_ring_geom" data="bore"/>
    <text name="rotorub_contact" data=")" + contact + R"("/>
    <numeric name="rotorub_clearance" data="5e-4"/>
    <numeric name="rotorub_friction" data=")" + std::to_string(friction) + R"("/>
    <numeric name="rotorub_restitution" data=")" + std::to_string(restitution) + R"("/>
  </custom></mujoco>)";
}

class TurningRing : public MujocoTest {
 protected:
  plugin::Hooks hooks_;
};

// Pressed against the ring by a load that turns with the rub's normal: at rest at angle 0, held by
// y = 0. Omega_r(t) = (mu N R / c_r) (1 - exp(-c_r t / J_r)), R = r + delta_0, while it slips.
TEST_F(TurningRing, IsSpunUpByTheRub) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = load(document(contact, kMu, kDrag, 0.5));
    const DataPointer d = start(m.get());
    d->qpos[kX] = kClearance;
    d->qvel[kSpin] = 1000.0;
    constexpr double kForce = 100.0, kReach = kRadius + kClearance;
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
          kMu * kForce * kReach / kDrag * (1.0 - std::exp(-kDrag * t / kRingInertia));
      worst = std::max(worst, std::abs(d->qvel[kRing] - speed));
    }
    EXPECT_GT(d->qvel[kRing], 90.0) << contact;
    EXPECT_LT(worst, 1e-3 * d->qvel[kRing]) << contact;
    EXPECT_NEAR(lowest, kForce, 0.02 * kForce) << contact;
    EXPECT_NEAR(highest, kForce, 0.02 * kForce) << contact;
    EXPECT_NEAR(sensor(m.get(), d.get(), "slip"),
                d->qvel[kY] + kRadius * d->qvel[kSpin] - kReach * d->qvel[kRing], 1e-3)
        << contact;
  }
}

// A ring that turns by itself, without friction, changes nothing: neither force nor place.
TEST_F(TurningRing, WithoutFrictionItMayTurnAsItLikes) {
  for (const char* contact : {"rigid", "coulomb"}) {
    for (const double speed : {0.0, 314.0, -3000.0}) {
      const ModelPointer m = load(document(contact, 0.0, 0.0, 0.5));
      const DataPointer d = start(m.get());
      d->qpos[kX] = kClearance;
      d->qvel[kRing] = speed;
      double lowest = 1e9, highest = 0.0;
      for (int k = 0; k < 3000; ++k) {
        d->qfrc_applied[kX] = 20.0;
        mj_step(m.get(), d.get());
        if (k < 500) continue;
        lowest = std::min(lowest, sensor(m.get(), d.get(), "normal_force"));
        highest = std::max(highest, sensor(m.get(), d.get(), "normal_force"));
      }
      EXPECT_NEAR(lowest, 20.0, 0.05) << contact << speed;
      EXPECT_NEAR(highest, 20.0, 0.05) << contact << speed;
      EXPECT_NEAR(sensor(m.get(), d.get(), "gap"), 0.0, 5e-8) << contact << speed;
    }
  }
}

// Impacts with friction on a ring that turns: about the ring's axis nothing is lost.
TEST_F(TurningRing, AngularMomentumIsConserved) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = load(document(contact, 0.3, 0.0, 0.5));
    const DataPointer d = start(m.get());
    d->qvel[kX] = 0.3;
    d->qvel[kY] = 0.2;
    d->qvel[kSpin] = 20.0;
    d->qvel[kRing] = 314.0;
    const auto momentum = [&] {
      return 2.0 * (d->qpos[kX] * d->qvel[kY] - d->qpos[kY] * d->qvel[kX]) +
             (100.0 + 1e-3) * d->qvel[kSpin] + kRingInertia * d->qvel[kRing];
    };
    const double before = momentum();
    for (int k = 0; k < 20000; ++k) mj_step(m.get(), d.get());
    EXPECT_LT(d->qvel[kRing], 310.0) << contact;
    // What changes hands is some 0.1 N m s.
    EXPECT_NEAR(momentum(), before, contact[0] == 'r' ? 1e-10 : 1e-6) << contact;
  }
}

// A rotor on one slide, with or without a spin.
std::string on_one_slide(const std::string& contact, const std::string& spin, const std::string& offset) {
  std::string text = document(contact, 0.15, 0.0, 0.5);
  const auto replace = [&text](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("<joint type=\"slide\" axis=\"0 1 0\"/>", "");
  replace("<joint type=\"hinge\" axis=\"0 0 1\" armature=\"100\"/>", spin);
  replace("<joint type=\"hinge\" axis=\"0 0 1\" damping=\"0.000000\"/>", "");
  replace("size=\"0.05 0.01\"", "size=\"0.05 0.01\" pos=\"" + offset + " 0 0\"");
  return text;
}

// Nothing there can slip: G_TT = 0.
TEST_F(TurningRing, ARotorOnOneSlideHasItsNormalForce) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = load(on_one_slide(contact, "", "0"));
    const DataPointer d = start(m.get());
    d->qvel[kX] = 0.3;
    d->qpos[kX] = 4.99e-4;
    for (int k = 0; k < 60; ++k) mj_step(m.get(), d.get());
    EXPECT_NEAR(d->qvel[kX], -0.15, contact[0] == 'r' ? 1e-12 : 0.01) << contact;
    for (int k = 0; k < 20000; ++k) {
      d->qfrc_applied[kX] = 40.0;
      mj_step(m.get(), d.get());
      ASSERT_TRUE(std::isfinite(d->qpos[kX])) << contact << k;
    }
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 40.0, 0.01) << contact;
  }
}

// The disc's centre 10 um off its axis, at 1000 rad/s: held at the ring, the shaft goes to and fro by
// x = delta_0 - e cos(phi), which takes N = F - m x''.
TEST_F(TurningRing, ACentreThatGoesRoundIsFollowed) {
  for (const char* contact : {"rigid", "coulomb"}) {
    std::string text =
        on_one_slide(contact, "<joint type=\"hinge\" axis=\"0 0 1\" armature=\"100\"/>", "1e-5");
    text.replace(text.find("rotorub_friction\" data=\"0.15"), 29, "rotorub_friction\" data=\"0.00");
    const ModelPointer m = load(text);
    const DataPointer d = start(m.get());
    constexpr double kOff = 1e-5, kSpeed = 1000.0, kForce = 100.0, kMass = 2.0;
    d->qpos[kX] = kClearance - kOff;
    d->qvel[1] = kSpeed;
    d->qfrc_applied[kX] = kForce;
    double worst = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double phi = d->qpos[1];
      mj_step(m.get(), d.get());
      if (k < 500) continue;
      const double x = kOff * kSpeed * kSpeed *
                       (std::cos(phi) - kOff / kClearance * std::cos(2.0 * phi));
      worst = std::max(worst, std::abs(sensor(m.get(), d.get(), "normal_force") - kForce + kMass * x));
    }
    EXPECT_LT(worst, 0.5) << contact;
  }
}

}  // namespace
}  // namespace rotorub::test
