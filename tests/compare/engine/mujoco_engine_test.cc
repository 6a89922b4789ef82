#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/engine/mujoco_engine.h"
#include "mjcf/soft_contact.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"

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

// ---------------------------------------------------------------- the solref that a run reports

TEST(Solref, OfTheDefaultIsMujocos) {
  mjtNum solref[mjNREF], solimp[mjNIMP];
  mj_defaultSolRefImp(solref, solimp);
  EXPECT_EQ(solref[0], DefaultSolref::kTimeConstant);
  EXPECT_EQ(solref[1], DefaultSolref::kDampingRatio);
  EXPECT_EQ(DefaultSolref::kStiffness, 2500.0);
  EXPECT_EQ(DefaultSolref::kDamping, 100.0);
}

std::string told_by(const Engine& engine, const scene::Scene& scene) {
  std::string told;
  RunRequest request;
  request.solref = &told;
  EXPECT_EQ(engine.run(scene, request).status, Status::kOk);
  return told;
}

TEST(Solref, IsThatOfTheRun) {
  using enum scene::ContactModel;
  const scene::Scene scene = shipped("bench_ring", {"run.end=1e-3"});
  EXPECT_EQ(told_by(*mujoco_engine(kRigid), scene), "");
  for (const scene::ContactModel model : {kCoulomb, kCone, kConeCoulomb}) {
    const SoftContact soft = soft_contact(scene, model, scene.run.step);
    EXPECT_EQ(told_by(*mujoco_engine(model), scene), solref_text(-soft.stiffness, -soft.damping));
  }
  EXPECT_EQ(told_by(*default_cone_engine(), scene), "0.02 1");
  // A compliant contact has its own stiffness and damping.
  EXPECT_EQ(told_by(*mujoco_engine(kCoulomb), shipped("compliant_ring", {"run.end=1e-3"})), "");
}

// ---------------------------------------------------------------- the keyphasor

constexpr double kTurn = 2.0 * std::numbers::pi;

std::vector<std::unique_ptr<Engine>> every_engine() {
  std::vector<std::unique_ptr<Engine>> all;
  for (const auto integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet, scene::Integrator::kEuler})
    all.push_back(native_engine(integrator));
  for (const auto contact :
       {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb, scene::ContactModel::kCone})
    all.push_back(mujoco_engine(contact));
  return all;
}

// A row of the same run that is requested at the instant of each pass equals the pass.
TEST(KeyphasorOfEveryEngine, IsARowAtItsInstant) {
  const std::vector<scene::Scene> scenes{
      test::shipped("bench_ring", {"run.end=0.05"}),  // held spin, contact
      test::shipped("run_up", {"run.end=0.1"}),       // a spin that rises
      test::shipped("bench_rig", {"run.end=0.06"}),   // free, through impacts and a rub
  };
  for (const scene::Scene& scene : scenes) {
    for (const auto& engine : every_engine()) {
      const Trajectory run = engine->run(scene, {});
      ASSERT_EQ(run.status, Status::kOk) << engine->name() << " " << run.message;
      const double turns = run.column("spin_angle").back() / kTurn;
      ASSERT_EQ(run.keyphasor.size(), static_cast<std::size_t>(turns)) << engine->name();
      ASSERT_GE(turns, 2.0) << scene.name;
      RunRequest request;
      request.output_times.emplace();
      for (const KeyphasorPass& pass : run.keyphasor) request.output_times->push_back(pass.t);
      const Trajectory again = engine->run(scene, request);
      ASSERT_EQ(again.rows(), run.keyphasor.size());
      for (std::size_t k = 0; k < again.rows(); ++k) {
        const KeyphasorPass& pass = run.keyphasor[k];
        const double mark = kTurn * static_cast<double>(k + 1);
        EXPECT_NEAR(again.column("spin_angle")[k], mark, 1e-12 * mark) << engine->name();
        EXPECT_NEAR(again.column("rotor_x")[k], pass.x, 1e-14) << engine->name();
        EXPECT_NEAR(again.column("rotor_y")[k], pass.y, 1e-14) << engine->name();
        EXPECT_NEAR(again.column("spin_speed")[k], pass.spin_speed, 1e-9 * pass.spin_speed);
      }
    }
  }
}

// A held spin of -50 Hz passes every 20 ms, in either sense.
TEST(KeyphasorOfEveryEngine, OfAHeldSpinIsOnTime) {
  const scene::Scene scene =
      test::shipped("bench_annular_rigid", {"rotor.speed=-50 Hz", "run.end=0.105"});
  for (const auto& engine : every_engine()) {
    const Trajectory run = engine->run(scene, {});
    ASSERT_EQ(run.keyphasor.size(), 5u) << engine->name() << ": where it starts is no pass";
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_NEAR(run.keyphasor[k].t, 0.02 * static_cast<double>(k + 1), 1e-14) << engine->name();
      EXPECT_LT(run.keyphasor[k].spin_speed, 0.0);
    }
  }
}

// A mistyped speed must not make the count endless.
TEST(KeyphasorOfEveryEngine, OfASpeedBeyondAllMeasureHasNone) {
  Keyphasor keyphasor;
  keyphasor.begin(0.0);
  const auto place = [](double mark) { return KeyphasorPass{mark, 0.0, 0.0, 1.0}; };
  for (const double angle : {1e9, 1e30, -1e300, 0.0}) keyphasor.follow(angle, place);
  EXPECT_TRUE(keyphasor.take().empty());
  keyphasor.follow(6.0 * std::numbers::pi, place);
  EXPECT_EQ(keyphasor.take().size(), 3u);
}

}  // namespace
}  // namespace rotorub::test
