// Replay: recorded commands of MuJoCo's actuators, comparisons with them, and the shadow beside
// them.
#include "compare/study/comparison_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/study/answer.h"
#include "compare/study/result.h"
#include "compare/study/scene_comparison.h"
#include "tests/compare/columns.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// bench_ring with a spring and a damper emulated through its actuator.
scene::Scene emulated(std::vector<std::string> more = {}) {
  more.insert(more.end(),
              {"controller.kind=passive", "controller.stiffness=5e4", "controller.damping=100"});
  return test::shipped("bench_ring", more);
}

struct Taped {
  Trajectory trajectory;
  std::shared_ptr<const CommandRecord> commands;
};

Taped taped(const scene::Scene& scene, scene::ContactModel contact, double step) {
  const auto commands = std::make_shared<CommandRecord>();
  RunRequest request;
  request.step = step;
  request.watch = recording(commands);
  Taped t;
  t.trajectory = mujoco_engine(contact)->run(scene, request);
  EXPECT_EQ(t.trajectory.status, Status::kOk) << t.trajectory.message;
  t.commands = commands;
  return t;
}

// The record has the command that the actuator received at each row.
TEST(CommandTape, HoldsWhatTheSeriesSays) {
  const scene::Scene scene = emulated({"run.end=0.01", "run.output_step=1e-4"});
  for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
    const Taped t = taped(scene, contact, 1e-5);
    const auto &time = t.trajectory.column("t"), &x = t.trajectory.column("control_x");
    double most = 0.0;
    for (std::size_t i = 1; i + 1 < time.size(); ++i) {
      most = std::max(most, std::abs(x[i]));
      // MuJoCo's own rows have the force of the step that ends there.
      const double at = contact == scene::ContactModel::kRigid ? time[i] : time[i] - 1e-5;
      EXPECT_NEAR(t.commands->at(at).x(), x[i], 1e-9 * (1.0 + std::abs(x[i]))) << time[i];
    }
    EXPECT_GT(most, 1.0) << "or nothing was told";
  }
}

// Without contact only MuJoCo's step differs: second order for the plugin's own.
TEST(Replay, WithoutContactTheStepAloneIsLeft) {
  const scene::Scene scene = emulated({"run.end=0.02", "force[0].amplitude=20"});
  const auto off = [&](double step) {
    const Taped t = taped(scene, scene::ContactModel::kRigid, step);
    RunRequest request;
    request.commands = t.commands;
    const Trajectory native = native_engine(scene::Integrator::kEvent)->run(scene, request);
    EXPECT_EQ(native.status, Status::kOk) << native.message;
    return std::hypot(native.column("rotor_x").back() - t.trajectory.column("rotor_x").back(),
                      native.column("rotor_y").back() - t.trajectory.column("rotor_y").back());
  };
  const double coarse = off(4e-5), fine = off(1e-5);
  EXPECT_GT(coarse / fine, 12.0);
  EXPECT_LT(coarse / fine, 20.0);
}

TEST(Replay, EnginesTakeWhatIsTheirs) {
  const scene::Scene scene = emulated({"run.end=1e-3"});
  RunRequest request;
  request.commands = std::make_shared<CommandRecord>();
  EXPECT_THROW(mujoco_engine(scene::ContactModel::kRigid)->run(scene, request),
               std::invalid_argument);
  request.commands = nullptr;
  request.watch = [](const WatchedStep&) {};
  EXPECT_THROW(native_engine(scene::Integrator::kEvent)->run(scene, request),
               std::invalid_argument);
}

// ---------------------------------------------------------------- whole comparisons

SceneComparison compared(const scene::Scene& scene, CompareMode mode) {
  CompareOptions options;
  options.mode = mode;
  options.timing_repeats = 1;
  options.twins = 2;
  return compare_scene(scene, options);
}

const SceneComparison& replayed_ring() {
  static const SceneComparison c = compared(emulated({"run.end=0.03"}), CompareMode::kReplay);
  return c;
}

TEST(Replay, EveryContactModelHasANativeRunOfItsOwn) {
  const SceneComparison& c = replayed_ring();
  EXPECT_TRUE(c.commands);
  ASSERT_EQ(c.models.size(), 5U);
  for (const ComparedModel& m : c.models) {
    EXPECT_EQ(m.native.has_value(), !c.decides(m)) << m.run.label;
    const Side& native = c.reference(m);
    EXPECT_EQ(native.engine, "native-event");
    EXPECT_EQ(native.limits.size(), figures().size());
    for (const FigureDifference& f : m.figures) {
      if (std::isnan(f.native) || std::isnan(f.other))
        continue;  // one of the runs has not this figure
      EXPECT_EQ(f.native, f.figure->value(native.metrics)) << f.figure->key;
      EXPECT_EQ(f.other, f.figure->value(m.run.metrics)) << f.figure->key;
    }
  }
  // The commands of the cone's run belong to another motion.
  const ComparedModel& shown = c.models[2];
  ASSERT_EQ(shown.run.label, "cone");
  EXPECT_NE(c.native.metrics.mean_force, shown.native->metrics.mean_force);
  EXPECT_EQ(c.models[0].trust, Trust::kYes) << answer_row(c, c.models[0]).why;
  const auto cone =
      result::json_of(comparisons_result({c})).at("scenes")[0].at("differences").at("cone");
  EXPECT_EQ(cone.at("figures").at("mean_force").at("native"), shown.native->metrics.mean_force);
  // A ring on springs is stable by itself, so its open loop has only the error of the step. The
  // interval is never smaller.
  for (const FigureDifference& f : c.models[0].figures) {
    EXPECT_GE(f.interval, f.replay_floor) << f.figure->key;
    if (std::string(f.figure->key) != "mean_force") continue;
    EXPECT_GT(f.replay_floor, 0.0);
    EXPECT_LT(f.replay_floor, 1e-4);
  }
}

TEST(Replay, WithoutAControllerItIsLockstepAndSaysSo) {
  const scene::Scene scene = test::shipped("bench_ring", {"run.end=0.02"});
  const SceneComparison replay = compared(scene, CompareMode::kReplay);
  const SceneComparison lockstep = compared(scene, CompareMode::kLockstep);
  EXPECT_FALSE(replay.commands);
  for (std::size_t k = 0; k < replay.models.size(); ++k) {
    EXPECT_FALSE(replay.models[k].native);
    for (std::size_t i = 0; i < figures().size(); ++i) {
      const FigureDifference &r = replay.models[k].figures[i], &l = lockstep.models[k].figures[i];
      if (std::isnan(l.native) || std::isnan(l.other))
        continue;  // one of the runs has not this figure
      EXPECT_EQ(r.native, l.native) << r.figure->key;
      EXPECT_EQ(r.other, l.other) << r.figure->key;
    }
  }
  EXPECT_NE(result::text_of(comparison_result(replay)).find("Replay equals lockstep here"),
            std::string::npos);
  EXPECT_EQ(mode_note(lockstep), "");
}

// ---------------------------------------------------------------- the shadow's column

TEST(ShadowColumn, IsTheNativeStepperAtMujocosStep) {
  const SceneComparison& c = replayed_ring();
  ASSERT_TRUE(c.shadow.side);
  const Trajectory& t = c.shadow.side->trajectory;
  EXPECT_EQ(t.integrator, "verlet");
  EXPECT_EQ(t.step, c.scene.run.step);
  EXPECT_EQ(t.steps, c.models[0].run.trajectory.steps);
  EXPECT_TRUE(c.shadow.driven);
  ASSERT_EQ(c.shadow.figures.size(), figures().size());
  // A stepper of the right law is nearer than the wrong law at the same step.
  const auto mean = [](const std::vector<JudgedFigure>& f) { return std::abs(f[0].deviation); };
  EXPECT_GT(mean(c.shadow.figures), 0.0);
  EXPECT_LT(mean(c.shadow.figures), mean(c.models[2].judged()));
  const std::string table = result::text_of(comparison_result(c));
  EXPECT_NE(table.find("shadow: native verlet"), std::string::npos);
  EXPECT_LE(test::widest_line(table), 80U) << "terminals are 80 columns wide";
}

TEST(ShadowColumn, IsThereWhereImpactsTakeTime) {
  CompareOptions options;
  options.mode = CompareMode::kResync;
  options.timing_repeats = 1;
  const scene::Scene scene = test::shipped(
      "bench_ring",
      {"run.end=0.005", "contact.compression_time=2e-5", "contact.expansion_time=2e-5"});
  const SceneComparison c = compare_scene(scene, options);
  EXPECT_TRUE(c.shadow.side) << c.shadow.absent;
}

}  // namespace
}  // namespace rotorub
