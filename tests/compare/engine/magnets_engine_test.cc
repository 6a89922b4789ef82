// The magnetic actuator in both engines.
#include <gtest/gtest.h>

#include <cmath>

#include "native_model/run/run_native.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

// With lag and limited rate in both engines the difference is MuJoCo's step and vanishes with it.
TEST(MagnetsEngine, ConvergesToTheNativeRun) {
  const scene::Scene scene = shipped(
      "bench_ring", {"run.end=0.02", "actuator.kind=electromagnet", "actuator.force_constant=4e-4",
                     "actuator.bias_current=3", "actuator.air_gap=5e-3", "actuator.coil_lag=2e-4",
                     "actuator.current_rate_limit=2000", "controller.kind=passive",
                     "controller.stiffness=5e4", "controller.damping=100"});
  const Trajectory reference = run_native(scene);
  ASSERT_EQ(reference.status, Status::kOk) << reference.message;
  const auto error = [&](double step) {
    const Trajectory t = mujoco_run(scene, {}, step);
    return std::hypot(t.column("rotor_x").back() - reference.column("rotor_x").back(),
                      t.column("rotor_y").back() - reference.column("rotor_y").back());
  };
  const double coarse = error(1e-5), fine = error(1e-6);
  EXPECT_LT(coarse, 2e-5);
  EXPECT_LT(fine, 2e-6);
  EXPECT_GT(coarse / fine, 5.0);
  EXPECT_GT(largest_size(reference, "current_1"), 0.1) << "or the magnets did nothing";
}

// The sliding law moves the ring to the rotor, limited by the voltage.
TEST(MagnetsEngine, TheVoltageLimitIsTheSameOnBothSides) {
  const scene::Scene scene =
      shipped("paper_magnetic", {"run.end=0.106", "rotor.modes=2", "actuator.coil_lag=1e-4",
                                 "actuator.voltage_limit=5", "actuator.inductance=20 mH",
                                 "actuator.resistance=2 Ohm"});
  const Trajectory native = run_native(scene);
  ASSERT_EQ(native.status, Status::kOk) << native.message;
  const Trajectory t = mujoco_run(scene, {}, 2e-6);
  EXPECT_NEAR(t.column("current_1").back(), native.column("current_1").back(),
              1e-3 * largest_size(native, "current_1"));
}

}  // namespace
}  // namespace rotorub::test
