// The recorded commands of one run in another: the record by hand, and runs that it drives.
#include "native_model/control/command_record.h"

#include <gtest/gtest.h>

#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

using test::trajectory_error;

constexpr double kSample = 1e-3;  // s, of the sampled controller below

scene::Scene sampled(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"run.end=0.02", "controller.kind=passive",
                                     "controller.stiffness=5e4", "controller.damping=100",
                                     "controller.sample_time=1e-3"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return test::shipped("bench_ring", overrides);
}

Trajectory run(const scene::Scene& scene, scene::Integrator integrator,
               std::shared_ptr<const CommandRecord> commands = nullptr,
               std::vector<double> times = {}) {
  NativeOptions options;
  options.integrator = integrator;
  options.commands = std::move(commands);
  if (!times.empty()) options.output_times = std::move(times);
  Trajectory t = test::complete(run_native(scene, options));
  return t;
}

// The commands of a sampled controller: the force half-way between its samples holds from the
// sample before.
std::shared_ptr<const CommandRecord> told(const scene::Scene& scene, const char* x, const char* y) {
  std::vector<double> halves;
  for (int k = 0; (k + 0.5) * kSample < scene.run.end; ++k) halves.push_back((k + 0.5) * kSample);
  const Trajectory t = run(scene, scene::Integrator::kEvent, nullptr, halves);
  auto record = std::make_shared<CommandRecord>();
  for (std::size_t k = 0; k < halves.size(); ++k) {
    record->add(static_cast<double>(k) * kSample, {t.column(x)[k], t.column(y)[k]});
  }
  return record;
}

TEST(CommandRecord, HoldsFromPieceToPiece) {
  CommandRecord record;
  EXPECT_EQ(record.at(5.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(record.mean(0.0, 1.0), Eigen::Vector2d(0.0, 0.0));
  record.add(1.0, {2.0, -1.0});
  record.add(1.5, {2.0, -1.0});  // the same again: no jump
  record.add(2.0, {4.0, 1.0});
  EXPECT_EQ(record.jumps(), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(record.at(0.999), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(record.at(1.0), Eigen::Vector2d(2.0, -1.0));
  EXPECT_EQ(record.at(1.999), Eigen::Vector2d(2.0, -1.0));
  EXPECT_EQ(record.at(100.0), Eigen::Vector2d(4.0, 1.0));
}

TEST(CommandRecord, MeansWeighByTime) {
  CommandRecord record;
  record.add(1.0, {2.0, 0.0});
  record.add(2.0, {4.0, 8.0});
  EXPECT_EQ(record.mean(1.25, 1.75), Eigen::Vector2d(2.0, 0.0));
  EXPECT_EQ(record.mean(1.5, 2.5), Eigen::Vector2d(3.0, 4.0));
  // A quarter of nothing, a half of (2, 0), a quarter of (4, 8).
  EXPECT_EQ(record.mean(0.5, 2.5), Eigen::Vector2d(2.0, 2.0));
  EXPECT_EQ(record.mean(2.0, 9.0), Eigen::Vector2d(4.0, 8.0));
}

// Only the loop is open: the trajectory is the same, through the impacts of bench_ring and into its
// lasting contact.
TEST(Replay, IsTheClosedLoopsTrajectory) {
  const scene::Scene scene = sampled();
  const auto commands = told(scene, "control_x", "control_y");
  ASSERT_GT(commands->jumps().size(), 10U) << "or nothing much was told";
  const Trajectory closed = run(scene, scene::Integrator::kEvent);
  const Trajectory open = run(scene, scene::Integrator::kEvent, commands);
  ASSERT_GT(closed.impacts.size(), 3U);
  EXPECT_LT(trajectory_error(closed, open), 1e-12);
  EXPECT_EQ(closed.impacts.size(), open.impacts.size());
  // Without the commands the motion differs.
  EXPECT_GT(trajectory_error(
                closed, run(scene, scene::Integrator::kEvent, std::make_shared<CommandRecord>())),
            1e-5);
}

// With magnets the record contains currents; the forces depend on the ring's own position.
TEST(Replay, GivesMagnetsTheirCurrents) {
  const scene::Scene scene = sampled({"actuator.kind=electromagnet", "actuator.force_constant=4e-4",
                                      "actuator.bias_current=3", "actuator.air_gap=5e-3"});
  const auto commands = told(scene, "current_1", "current_2");
  const Trajectory closed = run(scene, scene::Integrator::kEvent);
  const Trajectory open = run(scene, scene::Integrator::kEvent, commands);
  EXPECT_LT(trajectory_error(closed, open), 1e-12);
}

// The fixed steps use the mean command over each step, and keep their orders, 2 and 1. (At this
// step commands jump at the ends of steps.)
TEST(Replay, DrivesTheFixedStepsToo) {
  const scene::Scene scene = sampled();
  const auto commands = told(scene, "control_x", "control_y");
  const Trajectory reference = run(scene, scene::Integrator::kEvent, commands);
  const auto gain = [&](scene::Integrator integrator) {
    scene::Scene finer = scene;
    finer.run.step = 0.5 * scene.run.step;
    return trajectory_error(reference, run(scene, integrator, commands)) /
           trajectory_error(reference, run(finer, integrator, commands));
  };
  EXPECT_NEAR(gain(scene::Integrator::kVerlet), 4.0, 0.5);
  EXPECT_NEAR(gain(scene::Integrator::kEuler), 2.0, 0.3);
}

}  // namespace
}  // namespace rotorub
