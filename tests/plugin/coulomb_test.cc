// Contact model `coulomb`: its bounce, and its manners inside MuJoCo (rubs: exact_rub_test.cc).
#include <gtest/gtest.h>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

using CoulombContact = HookedTest;

// The bounce of the scene's restitution, without a load: MuJoCo's law makes up for loads while it
// pushes, so one that presses on the contact costs some of the rebound, a / (v sqrt K).
TEST_F(CoulombContact, BouncesByTheRestitution) {
  const scene::Scene scene =
      shipped("bench_billiard", {"mujoco.contact=coulomb", "mujoco.solref_stiffness=1e6",
                                 "run.step=2e-6", "contact.restitution=0.5", "initial.vy=[0.0]"});
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 30000 && d->qvel[0] > 0.0; ++k) mj_step(m.get(), d.get());
  for (int k = 0; k < 30000 && sensor(m.get(), d.get(), names::kGap) < 0.0; ++k) {
    mj_step(m.get(), d.get());
  }
  EXPECT_NEAR(d->qvel[0], -0.5 * 0.3, 0.3 * 2e-3);  // sqrt(K) step = 2e-3
}

// Hard: MuJoCo raises a friction coefficient of 0 to 1e-5 in its contacts.
TEST_F(CoulombContact, WithoutFrictionThereIsNone) {
  const ModelPointer m = load(mjcf(shipped("bench_billiard", {"mujoco.contact=coulomb"})));
  const DataPointer d = start(m.get());
  int touching = 0;
  for (int k = 0; k < 2000; ++k) {
    mj_step(m.get(), d.get());
    touching += sensor(m.get(), d.get(), names::kNormalForce) > 0.0 ? 1 : 0;
    EXPECT_EQ(sensor(m.get(), d.get(), names::kFrictionForce), 0.0);
  }
  EXPECT_GT(touching, 10);
}

}  // namespace
}  // namespace rotorub::test
