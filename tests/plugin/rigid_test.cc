// Contact model `rigid` against the exact answers of bounces, and its manners inside MuJoCo (rubs:
// exact_rub_test.cc).
#include <gtest/gtest.h>

#include <cmath>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/model/dynamics.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

using RigidContact = HookedTest;

scene::Scene rigid(const std::string& text, std::vector<std::string> overrides = {}) {
  overrides.push_back("mujoco.contact=rigid");
  return parsed(text, overrides);
}

scene::Scene rigid_bench(const std::string& name, std::vector<std::string> overrides = {}) {
  overrides.push_back("mujoco.contact=rigid");
  return shipped(name, overrides);
}

// Without loads a bounce on the ring keeps energy and angular momentum: 101 impacts in 0.2 s.
TEST_F(RigidContact, ABilliardKeepsEnergyAndAngularMomentum) {
  const scene::Scene scene = rigid_bench("bench_billiard", {"run.step=1e-5"});
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const auto momentum = [&] { return d->qpos[0] * d->qvel[1] - d->qpos[1] * d->qvel[0]; };
  const auto energy = [&] { return mju_dot(d->qvel, d->qvel, 2); };
  const double energy_start = energy(), momentum_start = momentum();
  int impacts = 0;
  for (int k = 0; k < 20000; ++k) {
    mj_step(m.get(), d.get());
    if (sensor(m.get(), d.get(), names::kNormalForce) > 0.0) ++impacts;
  }
  EXPECT_GE(impacts, 100);
  EXPECT_LE(impacts, 102);
  constexpr double kKept = 1e-9;  // relative; the chain's links weigh 5e-13 of the rotor
  EXPECT_NEAR(energy(), energy_start, kKept * energy_start);
  EXPECT_NEAR(momentum(), momentum_start, kKept * std::abs(momentum_start));
}

TEST_F(RigidContact, NeverLeavesTheRing) {
  const ModelPointer m = load(mjcf(rigid_bench("bench_ring", {"run.step=1e-4"})));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 5000; ++k) {
    mj_step(m.get(), d.get());
    // (v h)^2 / (2 delta_0) with v = 0.35 m/s: the normal is that of the step's begin.
    ASSERT_GT(sensor(m.get(), d.get(), names::kGap), -1.5e-6) << k;
  }
}

TEST_F(RigidContact, IsSeenByMujocoButNotSolvedByIt) {
  const ModelPointer m = load(mjcf(rigid(kAnnularRub)));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 20000; ++k) mj_step(m.get(), d.get());
  mj_forward(m.get(), d.get());
  ASSERT_EQ(d->ncon, 1);
  EXPECT_EQ(d->contact[0].exclude, 1);  // in gap
  EXPECT_EQ(d->contact[0].efc_address, -1);
  EXPECT_EQ(d->nefc, 0);
  EXPECT_NEAR(d->contact[0].dist, 0.0, 1e-9);
  EXPECT_NEAR(std::hypot(d->contact[0].pos[0], d->contact[0].pos[1]), 0.05 + 0.5e-3, 1e-9);
}

// A contact lasts from one step to the next alone. A state that is written at any other time begins
// without one.
TEST_F(RigidContact, AStateAtAnotherTimeIsSteppedAsAFreshOne) {
  const ModelPointer m = load(mjcf(rigid(kAnnularRub)));
  const DataPointer used = start(m.get()), fresh = start(m.get());
  for (int k = 0; k < 20000; ++k) mj_step(m.get(), used.get());
  ASSERT_GT(sensor(m.get(), used.get(), names::kNormalForce), 0.0);
  used->time += 7.5 * m->opt.timestep;
  for (int i = 0; i < 2; ++i) used->qvel[i] += 200.0 * used->qpos[i];  // about 0.1 m/s outward
  fresh->time = used->time;
  mju_copy(fresh->qpos, used->qpos, m->nq);
  mju_copy(fresh->qvel, used->qvel, m->nv);
  mj_step(m.get(), used.get());
  mj_step(m.get(), fresh.get());
  for (int i = 0; i < m->nv; ++i) EXPECT_EQ(used->qvel[i], fresh->qvel[i]) << i;
}

// A load of the user's own counts, and stays as it was.
TEST_F(RigidContact, LeavesTheUsersForcesAlone) {
  const ModelPointer m = load(mjcf(rigid(kBrake)));
  const DataPointer d = start(m.get());
  const int y = m->jnt_dofadr[mj_name2id(m.get(), mjOBJ_JOINT, "y_1")];
  d->qfrc_applied[y] = -50.0;
  d->xfrc_applied[6 * mj_name2id(m.get(), mjOBJ_BODY, names::kRotor) + 1] = -25.0;
  for (int k = 0; k < 10000; ++k) mj_step(m.get(), d.get());
  EXPECT_EQ(d->qfrc_applied[y], -50.0);
  EXPECT_NEAR(sensor(m.get(), d.get(), names::kNormalForce), 175.0, 1.75);
}

}  // namespace
}  // namespace rotorub::test
