#include "plugin/model/control.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/model/actuation.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

using ControlTest = HookedTest;

Eigen::Vector2d force_on_ring(const mjModel* m, const mjData* d) {
  const int id = mj_name2id(m, mjOBJ_SENSOR, mjcf_names::kControlForce);
  const mjtNum* f = d->sensordata + m->sensor_adr[id];
  return {f[0], f[1]};
}

TEST_F(ControlTest, CommandIsTheNativeLawsAtRest) {
  const scene::Scene scene = shipped("paper_sliding", {"controller.on=0.0", "rotor.modes=2"});
  const Model model = prepare(scene);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  d->qpos[0] = 2e-4;
  d->qpos[2] = -1e-4;
  mj_forward(m.get(), d.get());
  const Eigen::Vector2d wanted = control_command(model, 0.0, d->qpos, d->qvel);
  EXPECT_GT(wanted.norm(), 1.0);
  EXPECT_NEAR((force_on_ring(m.get(), d.get()) - wanted).norm(), 0.0, 1e-12 * wanted.norm());
}

// MuJoCo's velocities are those of half a step before. The law gets the velocity at the time of the
// positions, extended from the last two.
TEST_F(ControlTest, CommandIsThatOfTheVelocityAtItsTime) {
  const scene::Scene scene =
      shipped("paper_sliding", {"controller.on=0.0", "rotor.modes=2", "mujoco.contact=cone"});
  const Model model = prepare(scene);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  d->qpos[0] = 2e-4;
  mj_forward(m.get(), d.get());
  std::vector<double> now(d->qvel, d->qvel + m->nv);
  const double change = 0.02;  // m/s
  d->time += m->opt.timestep;
  d->qvel[0] += change;
  now[0] += 1.5 * change;
  mj_forward(m.get(), d.get());
  const Eigen::Vector2d wanted = control_command(model, d->time, d->qpos, now.data());
  EXPECT_GT((wanted - control_command(model, d->time, d->qpos, d->qvel)).norm(),
            1e-3 * wanted.norm());
  EXPECT_NEAR((force_on_ring(m.get(), d.get()) - wanted).norm(), 0.0, 1e-12 * wanted.norm());
}

TEST_F(ControlTest, NothingBeforeItIsOn) {
  const ModelPointer m = load(mjcf(shipped("paper_sliding")));
  const DataPointer d = start(m.get());
  d->qpos[0] = 2e-4;
  d->ctrl[0] = 5.0;  // the controller's, not the user's
  mj_forward(m.get(), d.get());
  EXPECT_EQ(force_on_ring(m.get(), d.get()).norm(), 0.0);
}

TEST_F(ControlTest, PassiveBearingObeysTheUser) {
  const ModelPointer m = load(mjcf(shipped("paper_passive")));
  ASSERT_EQ(m->nu, 2);
  const DataPointer d = start(m.get());
  d->ctrl[0] = 100.0;
  mj_step(m.get(), d.get());
  const double h = std::sqrt(0.5);
  EXPECT_NEAR((force_on_ring(m.get(), d.get()) - Eigen::Vector2d(100.0 * h, 100.0 * h)).norm(), 0.0,
              1e-12);
}

TEST_F(ControlTest, KeepsToTheForceLimit) {
  const ModelPointer m = load(mjcf(shipped(
      "paper_sliding", {"controller.on=0.0", "actuator.force_limit=10.0", "rotor.modes=2"})));
  const DataPointer d = start(m.get());
  d->qpos[0] = 3e-4;
  mj_forward(m.get(), d.get());
  EXPECT_LE(std::abs(d->actuator_force[0]), 10.0);
  EXPECT_LE(std::abs(d->actuator_force[1]), 10.0);
  EXPECT_GT(force_on_ring(m.get(), d.get()).norm(), 9.9);
}

}  // namespace
}  // namespace rotorub::test
