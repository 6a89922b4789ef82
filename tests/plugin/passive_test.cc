#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "mjcf/writer.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/prepare/prepare.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

using PassiveForces = HookedTest;

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
