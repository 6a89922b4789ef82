#include "plugin/model/control.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cmath>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/numerics/matrix_functions.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

using ControlTest = HookedTest;
using PassiveForces = HookedTest;

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
  // At 1e6 s the round-off of the time is larger than a millionth of the step.
  for (const double begin : {0.0, 1e6}) {
    const DataPointer d = start(m.get());
    d->time = begin;
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

// ---------------------------------------------------------------- passive
// Position of the disc at the end of the scene, MuJoCo at `step`. Its semi-implicit velocity is
// that of half a step before its position, and so is the one it is started with.
Eigen::Vector2d mujoco_end(const scene::Scene& given, double step) {
  scene::Scene scene = given;
  scene.run.step = step;
  const Model model = prepare(scene);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  Eigen::VectorXd a(model.nq());
  smooth_force(model, 0.0, model.q0.data(), model.v0.data(), {0.0, 0.0}, a.data());
  solve_mass(model, 0.0, model.q0.data(), a.data(), a.data());
  for (int i = 0; i < model.nq(); ++i) d->qvel[i] -= 0.5 * step * a[i];
  const auto steps = static_cast<int>(std::lround(scene.run.end / step));
  for (int k = 0; k < steps; ++k) mj_step(m.get(), d.get());
  return rotor_point(model, d->qpos);
}

// The native model's own: its loads are linear in the state at a constant speed, so exp(A t) is
// exact.
Eigen::Vector2d native_end(const scene::Scene& scene) {
  const Model model = prepare(scene);
  const int n = model.nq();
  Eigen::MatrixXd a(2 * n, 2 * n);
  for (int j = 0; j < 2 * n; ++j) {
    Eigen::VectorXd s = Eigen::VectorXd::Unit(2 * n, j), f(n);
    smooth_force(model, 0.0, s.data(), s.data() + n, {0.0, 0.0}, f.data());
    solve_mass(model, 0.0, s.data(), f.data(), f.data());
    a.col(j) << s.tail(n), f;
  }
  Eigen::VectorXd begin(2 * n);
  begin << model.q0, model.v0;
  const Eigen::VectorXd end = matrix_exp(a * scene.run.end) * begin;
  return rotor_point(model, end.data());
}

TEST_F(PassiveForces, FreeWhirlIsTheNativeOne) {
  const scene::Scene scene = parsed(kWhirl);
  const Eigen::Vector2d exact = native_end(scene);
  // MuJoCo's implicit damping is of first order: h (d + d_i)/m t, 1e-7 * 6/2 * 0.02 and what
  // internal damping adds.
  const double coarse = (mujoco_end(scene, 2e-6) - exact).norm() / exact.norm();
  const double fine = (mujoco_end(scene, 2e-7) - exact).norm() / exact.norm();
  EXPECT_LT(fine, 1e-6);
  EXPECT_LT(fine, 0.2 * coarse) << "the error must fall with the step";
}

// The same over a million steps: what swings stays within the same bounds at the end as at the
// begin.
TEST_F(PassiveForces, LongWhirlKeepsItsEnergy) {
  const scene::Scene scene = parsed(kUndampedWhirl);
  const Model model = prepare(scene);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  constexpr int kBlocks = 100, kBlock = 10000;
  double highest[kBlocks] = {}, mean[kBlocks] = {};
  for (int block = 0; block < kBlocks; ++block) {
    for (int k = 0; k < kBlock; ++k) {
      mj_step(m.get(), d.get());
      const double e = energy(model, 0.0, d->qpos, d->qvel);
      highest[block] = std::max(highest[block], e);
      mean[block] += e / kBlock;
    }
  }
  for (int block = 0; block < kBlocks; ++block) {
    EXPECT_LT(highest[block], highest[0] * 1.01) << block;
    EXPECT_NEAR(mean[block], mean[0], 1e-3 * mean[0]) << block;
  }
}

}  // namespace
}  // namespace rotorub::test
