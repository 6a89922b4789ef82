// The native model beside MuJoCo's under the actuator: the user's commands, coils that lag, the
// force of a magnet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/stepping/stepper.h"
#include "plugin/make_config.h"
#include "tests/plugin/shadow.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

// Without a controller in the scene the user's commands drive both.
TEST_F(Shadow, PassiveBearingFollowsTheUsersCommands) {
  const scene::Scene scene =
      shadowed("paper_passive", {"force[0].on=0.0", "initial.steady=false", "rotor.modes=2"});
  const ModelPointer m = load(mjcf(scene));
  const plugin::Config config = plugin::make_config(m.get());
  const DataPointer d = start(m.get());
  VerletStepper native(config.model, scene.run.step);
  double moved = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double a = 300.0 * std::sin(0.01 * k), b = k < 1500 ? 0.0 : 2e9;  // b: to the limit
    d->ctrl[0] = a;
    d->ctrl[1] = b;
    mj_step(m.get(), d.get());
    const std::vector<double> now = shadow_of(config, d.get());
    ASSERT_TRUE(std::equal(now.begin(), now.begin() + config.model.nq(), native.q())) << k;
    const double f1 = a, f2 = std::min(b, config.model.first().force_limit);
    constexpr double kRoot = 0.70710678118654752440;
    native.step(k, {kRoot * (f1 - f2), kRoot * (f1 + f2)});
    moved = std::max(moved, point(m.get(), d.get(), names::kShadowStator).norm());
  }
  EXPECT_GT(moved, 1e-4) << "the ring was pushed";
}

// Coils that lag are coordinates of the native model that MuJoCo's has not.
TEST_F(Shadow, CarriesTheCoils) {
  const scene::Scene scene =
      shadowed("paper_magnetic",
               {"actuator.coil_lag=1e-4", "actuator.current_rate_limit=5000", "force[0].on=0.0",
                "initial.steady=false", "controller.on=0.002", "rotor.modes=2"});
  constexpr int kSteps = 2000;
  const Trajectory native = every_step(scene, kSteps);
  ASSERT_EQ(native.status, Status::kOk);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  for (std::size_t k = 0; k <= kSteps; ++k) {
    mj_step(m.get(), d.get());
    ASSERT_EQ(point(m.get(), d.get(), names::kShadowStator).x(), native.column("stator_x")[k]) << k;
    ASSERT_EQ(point(m.get(), d.get(), names::kShadowRotor).x(), native.column("rotor_x")[k]) << k;
  }
  EXPECT_GT(std::abs(native.column("current_1").back()), 0.1);
}

// What a magnet without a controller gives is known from MuJoCo: the user's current, the bias and
// the lag are in it.
TEST_F(Shadow, TakesTheMagnetsForceFromMujoco) {
  const ModelPointer m = load(mjcf(
      shadowed("paper_magnetic", {"controller=none", "actuator.coil_lag=1e-4", "rotor.modes=2"})));
  const DataPointer d = start(m.get());
  double apart = 0.0, moved = 0.0;
  for (int k = 0; k < 2000; ++k) {
    d->ctrl[0] = std::sin(0.01 * k);
    mj_step(m.get(), d.get());
    const Eigen::Vector2d its = point(m.get(), d.get(), names::kShadowStator);
    const mjtNum* own = d->qpos + m->nq - 2;
    apart = std::max(apart, (its - Eigen::Vector2d(own[0], own[1])).norm());
    moved = std::max(moved, its.norm());
  }
  EXPECT_GT(moved, 1e-4);
  EXPECT_LT(apart, 0.02 * moved);
}

}  // namespace
}  // namespace rotorub::test
