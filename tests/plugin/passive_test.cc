#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "mjcf/writer.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/run/run_native.h"
#include "native_model/system/actuation.h"
#include "plugin/hooks.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

class PassiveForces : public MujocoTest {
 protected:
  plugin::Hooks hooks_;
};

// Position of the disc at the end of the scene, MuJoCo at `step`. Its semi-implicit velocity is
// that of half a step before its position, and so is the one it is started with.
Eigen::Vector2d mujoco_end(const scene::Scene& given, double step) {
  scene::Scene scene = given;
  scene.run.step = step;
  const Model model = make_model(scene);
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
  const Model model = make_model(scene);
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

// Explicit Euler would gain exp(h g^2 Omega^2 / (2 m^2) t): 20 in a second here.
TEST_F(PassiveForces, GyroscopicTermsDoNotFeed) {
  const scene::Scene scene = parsed(kUndampedWhirl);
  const Model model = make_model(scene);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const double begin = energy(model, 0.0, d->qpos, d->qvel);
  double lowest = begin, highest = begin;
  for (int k = 0; k < 100000; ++k) {
    mj_step(m.get(), d.get());
    const double e = energy(model, 0.0, d->qpos, d->qvel);
    lowest = std::min(lowest, e);
    highest = std::max(highest, e);
  }
  // A symplectic step swings about the energy by its own first order, omega h.
  EXPECT_GT(lowest, begin * (1.0 - 0.03));
  EXPECT_LT(highest, begin * (1.0 + 0.03));
}

// The same over a million steps: what swings stays within the same bounds at the end as at the
// begin.
TEST_F(PassiveForces, LongWhirlKeepsItsEnergy) {
  const scene::Scene scene = parsed(kUndampedWhirl);
  const Model model = make_model(scene);
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

TEST_F(PassiveForces, GravityActsOnTheModes) {
  const std::string text = R"(
[run]
end = 1.0
step = 1e-5
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [2000.0]
[gravity]
acceleration = [0.0, -9.81]
)";
  const ModelPointer m = load(mjcf(parsed(text)));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 30000; ++k) mj_step(m.get(), d.get());
  EXPECT_NEAR(d->qpos[1], -2.0 * 9.81 / 2e5, 1e-12);
}

// Spin and bending are coupled through the mass matrix by unbalance: the same run-up in both
// models.
TEST_F(PassiveForces, UnbalanceReactsOnTheFreeSpin) {
  const std::string text = R"(
[run]
end = 0.05
step = 2e-6
[rotor]
speed = "20 Hz"
length = 0.6
E = "210 GPa"
nu = 0.3
rho = 7850.0
modes = 1
damping_ratio = 0.01
[[rotor.section]]
from = 0.0
to = 0.6
diameter = "18 mm"
[[rotor.disc]]
z = 0.3
mass = 2.0
Jt = 1.8e-3
Jp = 3.6e-3
eccentricity = "5 mm"
[[rotor.bearing]]
z = 0.03
stiffness = 2e7
[[rotor.bearing]]
z = 0.57
stiffness = 2e7
[drive]
kind = "linear"
gain = 0.1
speed = "60 Hz"
inertia = 2e-3
)";
  const scene::Scene scene = parsed(text);
  const Model model = make_model(scene);
  NativeOptions options;
  options.integrator = scene::Integrator::kVerlet;
  const Trajectory native = run_native(scene, options);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const auto steps = static_cast<int>(std::lround(scene.run.end / scene.run.step));
  for (int k = 0; k < steps; ++k) mj_step(m.get(), d.get());
  // First order in the step: omega h/2 = 4e-4 of the deflection.
  const double size = 5e-3;
  EXPECT_NEAR(rotor_point(model, d->qpos).x(), native.column("rotor_x").back(), 2e-3 * size);
  EXPECT_NEAR(rotor_point(model, d->qpos).y(), native.column("rotor_y").back(), 2e-3 * size);
  const double speed = native.column("spin_speed").back();
  EXPECT_GT(std::abs(speed - scene.rotor.speed), 10.0);
  EXPECT_NEAR(spin_speed(model, d->qvel), speed, 1e-4 * speed);
}

}  // namespace
}  // namespace rotorub::test
