// A user's rotor that its joints guide otherwise than by two slides and a hinge through its centre.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kClearance = 5e-4;

class GuidedRotor : public HookedTest {
 protected:
  enum { kX, kSpin };
  // In a ring that stands still, with or without a spin.
  static std::string on_one_slide(const std::string& contact, double friction,
                                  const std::string& spin = "") {
    Machine x;
    x.contact = contact;
    x.friction = friction;
    x.ring_moves = false;
    const std::string text =
        replaced(document(x), R"(<joint name="rotor_y" type="slide" axis="0 1 0"/>)", "");
    return replaced(text, R"(<joint name="spin" type="hinge" axis="0 0 1" />)", spin);
  }
};

// Nothing there can slip: G_TT = 0.
TEST_F(GuidedRotor, ARotorOnOneSlideHasItsNormalForce) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = load(on_one_slide(contact, 0.15));
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

// The disc's centre 10 um off its axis, at 1000 rad/s: held at the ring, the shaft goes to and fro
// by x = delta_0 - e cos(phi), which takes N = F - m x''.
TEST_F(GuidedRotor, ACentreThatGoesRoundIsFollowed) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const std::string text =
        replaced(on_one_slide(contact, 0.0,
                              R"(<joint name="spin" type="hinge" axis="0 0 1" armature="100"/>)"),
                 "size=\"0.05 0.01\"", "size=\"0.05 0.01\" pos=\"1e-5 0 0\"");
    const ModelPointer m = load(text);
    const DataPointer d = start(m.get());
    constexpr double kOff = 1e-5, kSpeed = 1000.0, kForce = 100.0, kMass = 2.0;
    d->qpos[kX] = kClearance - kOff;
    d->qvel[kSpin] = kSpeed;
    d->qfrc_applied[kX] = kForce;
    double worst = 0.0;
    for (int k = 0; k < 3000; ++k) {
      const double phi = d->qpos[kSpin];
      mj_step(m.get(), d.get());
      if (k < 500) continue;
      const double x =
          kOff * kSpeed * kSpeed * (std::cos(phi) - kOff / kClearance * std::cos(2.0 * phi));
      worst =
          std::max(worst, std::abs(sensor(m.get(), d.get(), "normal_force") - kForce + kMass * x));
    }
    EXPECT_LT(worst, 0.5) << contact;
  }
}

}  // namespace
}  // namespace rotorub::test
