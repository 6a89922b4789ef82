// The passes of the mark on the shaft: every engine outputs them at their instants.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <vector>

#include "compare/engine/engine.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

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
}  // namespace rotorub
