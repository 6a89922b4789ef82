#include "compare/engine/mujoco_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "native_model/run/run_native.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"

namespace rotorub::test {
namespace {

// Not MujocoTest: the engine sets its own handlers.

TEST(MujocoEngine, SeriesHasTheNativeColumns) {
  const scene::Scene scene = shipped("paper_sliding", {"run.end=0.002"});
  const Trajectory mujoco = run_mujoco(scene), native = run_native(scene);
  ASSERT_EQ(mujoco.series.size(), native.series.size());
  for (std::size_t i = 0; i < mujoco.series.size(); ++i) {
    EXPECT_EQ(mujoco.series[i].name, native.series[i].name);
    EXPECT_EQ(mujoco.series[i].values.size(), native.series[i].values.size());
    for (const double value : mujoco.series[i].values) EXPECT_TRUE(std::isfinite(value));
  }
  EXPECT_EQ(mujoco.column("t"), native.column("t"));
}

TEST(MujocoEngine, AskedTimesArePrintedExactly) {
  MujocoOptions options;
  options.output_times = std::vector<double>{0.0, 1.23456e-3, 0.01};
  const Trajectory t = run_mujoco(shipped("bench_ring", {"run.end=0.01"}), options);
  EXPECT_EQ(t.column("t"), *options.output_times);
}

TEST(MujocoEngine, EpisodesHaveTheImpulseOfTheRun) {
  const Trajectory t = mujoco_run(shipped("bench_drop"), scene::ContactModel::kCoulomb);
  double sum = 0.0;
  for (const Impact& impact : t.impacts) {
    sum += impact.normal_impulse;
    EXPECT_GE(impact.normal_impulse, 0.0);
    EXPECT_LE(impact.gap_rate_before, 0.0);
    EXPECT_LE(impact.energy_change, 1e-9);
  }
  EXPECT_NEAR(sum, t.statistics.impulse_total, 1e-12 * sum);
  EXPECT_NEAR(t.impacts[0].t, 10.0964e-3, 2e-5);
  EXPECT_NEAR(t.impacts[0].gap_rate_after / -t.impacts[0].gap_rate_before, 0.5, 0.04);
}

TEST(MujocoEngine, InterruptKeepsWhatThereIs) {
  std::atomic<bool> stop{true};
  MujocoOptions options;
  options.interrupt = &stop;
  const Trajectory t = run_mujoco(shipped("bench_ring"), options);
  EXPECT_EQ(t.status, Status::kInterrupted);
  EXPECT_LT(t.steps, 50000);
  EXPECT_NEAR(t.end, static_cast<double>(t.steps) * 1e-5, 1e-15);
  EXPECT_GE(t.rows(), 1u);
}

TEST(MujocoEngine, DivergenceIsAStatus) {
  // The spin grows without bounds, beyond MuJoCo's own.
  const scene::Scene scene = parsed(R"(
[run]
end = 5.0
step = 1e-4
[rotor]
speed = 0.0
[rotor.modal]
mass = [1.0]
stiffness = [1e2]
damping = [0.0]
inertia = 1e-3
[drive]
kind = "linear"
gain = 5e-6
speed = 1e12
[initial]
x = [1e-3]
)");
  const Trajectory t = run_mujoco(scene);
  EXPECT_EQ(t.status, Status::kDiverged);
  EXPECT_NE(t.message.find(" at t = "), std::string::npos) << t.message;
  EXPECT_GT(t.rows(), 10u);
  for (const double value : t.column("rotor_x")) EXPECT_TRUE(std::isfinite(value));
  // The process continues, and the next run is unaffected.
  EXPECT_EQ(run_mujoco(shipped("bench_drop")).status, Status::kOk);
}

// A magnetic bearing that is stronger than the shaft causes exponential growth, and no ring stops
// it.
TEST(MujocoEngine, ARotorThatNothingHoldsIsOutOfRange) {
  const Trajectory t = run_mujoco(parsed(R"(
[run]
end = 5.0
step = 1e-4
[rotor]
speed = 0.0
[rotor.modal]
mass = [1.0]
stiffness = [1e2]
damping = [0.0]
[magnetic_bearing]
negative_stiffness = 1e4
[initial]
x = [1e-3]
)"));
  EXPECT_EQ(t.status, Status::kOutOfRange);
  EXPECT_NE(t.message.find("the rotor has left"), std::string::npos) << t.message;
}

TEST(MujocoEngine, StepBeyondStabilityIsRefused) {
  // 2 / omega is 6.3e-3
  const Trajectory t = run_mujoco(shipped("bench_ring"), mujoco_options({}, 0.01));
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_EQ(t.steps, 0);
  EXPECT_FALSE(t.message.empty());
}

TEST(MujocoEngine, RefusesWhatIsNotOffered) {
  scene::Scene scene = shipped("bench_ring");
  scene.mujoco.integrator = scene::MujocoIntegrator::kRk4;
  EXPECT_THROW(run_mujoco(scene), scene::SceneError);
  scene = shipped("bench_ring");
  scene.text.clear();
  EXPECT_THROW(run_mujoco(scene), std::invalid_argument);
}

// The balance of soft contacts is taken at MuJoCo's staggered times. Its residual in a run without
// contact falls with the square of the step, and does not grow during the run: far from resonance
// the work of the load is thousands of times the energy of the orbit.
TEST(MujocoEngine, TheBalanceOfAFreeRunFallsWithTheSquareOfTheStepAndDoesNotGrow) {
  constexpr double kRate = 2.0e4;  // 1/s^2, twice what is found
  const std::vector<std::string> free = {"contact.clearance=40mm", "drive=none",
                                         "force[0].frequency=500.0"};
  for (const auto contact : {scene::ContactModel::kCone, scene::ContactModel::kCoulomb}) {
    for (const double step : {1e-4, 1e-5}) {
      for (const char* end : {"run.end=0.05", "run.end=0.2", "run.end=1.0"}) {
        std::vector<std::string> overrides = free;
        overrides.push_back(end);
        const Trajectory t = mujoco_run(shipped("bench_ring", overrides), contact, step);
        ASSERT_EQ(t.statistics.contact_time, 0.0);
        EXPECT_LT(t.statistics.energy_residual(), kRate * step * step) << step << " " << end;
      }
    }
  }
}

// Impacts and sampled commands of a native step in MuJoCo have the same balance as in the native
// run.
TEST(MujocoEngine, TheBalanceOfRigidIsThatOfVerlet) {
  const std::vector<std::string> finite = {"contact.compression_time=1e-3",
                                           "contact.expansion_time=5e-4", "run.end=0.1"};
  const std::vector<std::string> held = {
      "controller={kind=\"passive\",stiffness=1e5,damping=100.0,sample_time=1e-3}", "run.end=0.1"};
  for (const std::vector<std::string>& overrides : {finite, held}) {
    const scene::Scene scene = shipped("bench_ring", overrides);
    const double native = run_with(scene, scene::Integrator::kVerlet).statistics.energy_residual();
    const Trajectory t = mujoco_run(scene);
    EXPECT_LT(native, 1e-6);
    EXPECT_NEAR(t.statistics.energy_residual(), native, 1e-9);
  }
}

// A load and a command jump within a step and open a lasting contact.
TEST(MujocoEngine, RigidIsVerletWhereLoadsAndCommandsJumpInContact) {
  for (const char* jump :
       {"force[0].off=20.0075e-3",
        "controller={kind=\"passive\",stiffness=2e6,damping=10.0,on=20.003e-3}"}) {
    const scene::Scene scene = shipped(
        "bench_ring", {"drive=none", "rotor.speed=300.0", "initial.x=[0.5e-3]", "stator.mass=20.0",
                       "force[0]={kind=\"constant\",vector=[100.0,0.0]}",
                       "rotor.modal.stiffness=[2e4]", "run.end=30ms", jump});
    const Trajectory native = run_with(scene, scene::Integrator::kVerlet), t = run_mujoco(scene);
    ASSERT_EQ(t.status, Status::kOk) << t.message;
    ASSERT_LT(t.statistics.contact_time, 0.0299) << "it opens";
    EXPECT_NEAR(t.column("rotor_x").back(), native.column("rotor_x").back(), 1e-12);
    EXPECT_NEAR(t.column("rotor_y").back(), native.column("rotor_y").back(), 1e-12);
  }
}

}  // namespace
}  // namespace rotorub::test
