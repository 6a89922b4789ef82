// `rigid` beside constraints whose force has a bound: friction losses, limits and contacts that a
// load presses. A blow takes no time, so a bounded force has no impulse in it: the disc of 2 kg
// leaves the ring of 1 kg with Poisson's restitution as if the ring were free, and what holds the
// ring brakes it afterwards. A disc that 100 N press onto a ring that 1000 N hold comes to rest.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mjcf/names.h"
#include "plugin/model/user_data.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

class SaturatingRows : public HookedTest {
 protected:
  static constexpr double kTime = 1e-5, kDisc = 2.0, kBand = 1.0;  // s, kg, kg
  static constexpr double kHeld = 1000.0, kPush = 100.0;           // N
  static constexpr int kDiscX = 0, kBandX = 3, kBandY = 4;

  struct Held {
    const char* name;
    Machine machine;
    double pressed_x = 0.0, pressed_y = 0.0;  // N, on the ring
  };
  static Held friction_loss() {
    Machine x;
    x.ring_joint = "frictionloss=\"1000\" solimpfriction=\"0.9999 0.9999 0.001\"";
    return {"friction loss of a joint", x};
  }
  static Held tendon_loss() {
    Machine x;
    x.constraints =
        "<tendon><fixed frictionloss=\"1000\" solimpfriction=\"0.9999 0.9999 0.001\">"
        "<joint joint=\"ring_x\" coef=\"1\"/></fixed></tendon>";
    return {"friction loss of a tendon", x};
  }
  static Held limit() {
    Machine x;
    x.ring_joint = "limited=\"true\" range=\"1e-7 1\" solimplimit=\"0.9999 0.9999 0.001\"";
    return {"limit of a joint", x, -kHeld};
  }
  static Held tendon_limit() {
    Machine x;
    x.constraints =
        "<tendon><fixed limited=\"true\" range=\"1e-7 1\" solimplimit=\"0.9999 0.9999 0.001\">"
        "<joint joint=\"ring_x\" coef=\"1\"/></fixed></tendon>";
    return {"limit of a tendon", x, -kHeld};
  }
  static Held stop() {
    Machine x;
    x.ring_geoms = R"(<geom name="cheek" type="sphere" size="0.01" pos="-0.06 0 0"/>)";
    x.bodies = R"(<geom name="stop" type="sphere" size="0.01" pos="-0.0799999 0 0"/>)";
    x.pairs = "<pair geom1=\"cheek\" geom2=\"stop\" condim=\"1\"" + kHard + "/>";
    return {"contact without friction", x, -kHeld};
  }
  // A wall to which 1000 N press the ring, with a friction of 1.
  static Held wall(const std::string& cone) {
    Machine x;
    x.ring_geoms = R"(<geom name="cheek" type="sphere" size="0.01" pos="0 -0.06 0"/>)";
    x.bodies =
        R"(<geom name="wall" type="plane" size="1 1 1" pos="0 -0.0699999 0" zaxis="0 1 0"/>)";
    x.pairs =
        "<pair geom1=\"wall\" geom2=\"cheek\" condim=\"3\" friction=\"1 1 0 0 0\"" + kHard + "/>";
    x.option = "cone=\"" + cone + "\"";
    return {"contact with friction", x, 0.0, -kHeld};
  }
  static std::vector<Held> bounded() {
    return {friction_loss(), tendon_loss(), limit(), tendon_limit(), stop()};
  }

  // The disc, a micrometre off the ring, which it meets in the first step.
  static DataPointer begin(const mjModel* m, const Held& held, double speed) {
    DataPointer d = start(m);
    d->qpos[kDiscX] = 5e-4 - 0.5 * speed * kTime;
    d->qvel[kDiscX] = speed;
    d->qfrc_applied[kBandX] = held.pressed_x;
    d->qfrc_applied[kBandY] = held.pressed_y;
    return d;
  }
};

// From 0.05 m/s on what holds the ring, 0.01 m/s a step, does not close the gap again.
TEST_F(SaturatingRows, ABlowHasTheRestitutionOfAFreeRing) {
  for (Held held : bounded()) {
    for (const double restitution : {0.5, 0.8}) {
      for (const double speed : {0.05, 0.3}) {
        SCOPED_TRACE(testing::Message() << held.name << ", e " << restitution << ", " << speed);
        held.machine.restitution = restitution;
        const ModelPointer m = load(document(held.machine));
        const DataPointer d = begin(m.get(), held, speed);
        mj_step(m.get(), d.get());
        const double impulse = (1.0 + restitution) * speed / (1.0 / kDisc + 1.0 / kBand);
        // Before, limits and stop push the ring by some um/s.
        EXPECT_NEAR(d->qvel[kDiscX], speed - impulse / kDisc, 5e-6);
        EXPECT_NEAR(d->qvel[kBandX], (impulse - kHeld * kTime) / kBand, 5e-6);
        EXPECT_NEAR(first_contact(d.get()).gap_rate_after,
                    -restitution * first_contact(d.get()).gap_rate_before, 1e-8);
      }
    }
  }
}

// MuJoCo's friction cone takes part in the blow, as it ties friction to a normal force of its own.
TEST_F(SaturatingRows, ABlowBesideAFrictionConeHasItsRestitution) {
  for (const char* cone : {"elliptic", "pyramidal"}) {
    for (const double restitution : {0.5, 0.8}) {
      Held held = wall(cone);
      held.machine.restitution = restitution;
      const ModelPointer m = load(document(held.machine));
      const DataPointer d = begin(m.get(), held, 0.3);
      mj_step(m.get(), d.get());
      EXPECT_NEAR(first_contact(d.get()).gap_rate_after,
                  -restitution * first_contact(d.get()).gap_rate_before, 1e-6)
          << cone;
    }
  }
}

// A blow of 0.005 m/s, that the friction loss ends within the step, 0.01 m/s: disc and ring go on
// together, with (2 kg 0.005 m/s - 1000 N h) / 3 kg = 0, and stand.
TEST_F(SaturatingRows, AWeakBlowEndsInItsStep) {
  for (const Held& held : bounded()) {
    const ModelPointer m = load(document(held.machine));
    const DataPointer d = begin(m.get(), held, 0.005);
    mj_step(m.get(), d.get());
    EXPECT_NEAR(d->qvel[kDiscX], 0.0, 1e-5) << held.name;
    EXPECT_NEAR(d->qvel[kBandX], 0.0, 1e-5) << held.name;
  }
}

TEST_F(SaturatingRows, APressedDiscComesToRest) {
  std::vector<Held> all = bounded();
  all.push_back(wall("elliptic"));
  all.push_back(wall("pyramidal"));
  for (Held held : all) {
    for (const double restitution : {0.5, 0.8}) {
      SCOPED_TRACE(testing::Message() << held.name << ", e " << restitution);
      held.machine.restitution = restitution;
      const ModelPointer m = load(document(held.machine));
      const DataPointer d = begin(m.get(), held, 0.1);
      d->qfrc_applied[kDiscX] = kPush;
      // They reach that at B = 100 /s.
      constexpr int kSteps = 16000, kSettled = 14000;
      int touching = 0;
      double impulse = 0.0, from = 0.0;
      for (int k = 0; k < kSteps; ++k) {
        if (k == kSettled) from = d->qpos[kBandX];
        mj_step(m.get(), d.get());
        if (k < kSettled) continue;
        const double force = sensor(m.get(), d.get(), mjcf_names::kNormalForce);
        touching += force > 0.0;
        impulse += force * kTime;
      }
      const double time = (kSteps - kSettled) * kTime;
      EXPECT_EQ(touching, kSteps - kSettled);
      // Beside a wall the ring also creeps along y, and the contact turns out of x.
      if (held.pressed_y != 0.0) continue;
      EXPECT_NEAR(impulse / time, kPush, 1e-3 * kPush);
      // MuJoCo's rows creep, by F R / B = 100 N 1e-4 /kg / (100 /s) and its like.
      EXPECT_NEAR((d->qpos[kBandX] - from) / time, 0.0, 3e-4);
      EXPECT_NEAR(d->qpos[kDiscX] - d->qpos[kBandX], 5e-4, 1e-9);
    }
  }
}

// Two rings about one shaft, 500 N of friction loss each.
TEST_F(SaturatingRows, TwoRingsOnOneShaftToo) {
  TwoRings x;
  x.ring_mass = 1.0;
  std::string text = document(x);
  for (const std::string ring : {"ring", "holder"}) {
    const std::string joint = R"(><joint type="slide" axis="1 0 0")";
    const std::string body =
        "<body name=\"" + ring + "\" pos=\"0 0 " + (ring == "ring" ? "-0.1" : "0.1") + "\"";
    text = replaced(text, body + joint,
                    body + joint + R"( frictionloss="500" solimpfriction="0.9999 0.9999 0.001")");
  }
  const ModelPointer m = load(text);
  const DataPointer d = start(m.get());
  d->qpos[0] = 5e-4 - 1e-7;
  d->qvel[0] = 0.1;
  d->qfrc_applied[0] = kPush;
  const int first = m->nv - 4, second = m->nv - 2;
  mj_step(m.get(), d.get());
  const double closing = 0.1 + kPush / kDisc * kTime;
  const double each = 0.5 * 1.5 * closing / (1.0 / kDisc + 1.0 / 2.0);
  EXPECT_NEAR(d->qvel[0], closing - 2.0 * each / kDisc, 1e-7);
  for (const int ring : {first, second}) EXPECT_NEAR(d->qvel[ring], each - 500.0 * kTime, 1e-7);
  for (int k = 0; k < 14000; ++k) mj_step(m.get(), d.get());
  for (int k = 0; k < 100; ++k) {
    mj_step(m.get(), d.get());
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 0.5 * kPush, 1e-2);
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force_2"), 0.5 * kPush, 1e-2);
  }
  for (const int ring : {first, second}) EXPECT_NEAR(d->qvel[ring], 0.0, 1e-4);
}

}  // namespace
}  // namespace rotorub::test
