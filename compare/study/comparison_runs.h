// The runs that a comparison is made of: who takes part, at which steps, and for how long.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/study/scene_comparison.h"
#include "compare/study/twins.h"
#include "native_model/control/command_record.h"
#include "native_model/scene/scene.h"

namespace rotorub {

struct Contestant {
  std::string label;
  std::unique_ptr<Engine> engine;
  double work;  // of one run at the scene's step, in units of a native one: for the progress bar
  bool climbs = true;  // run at smaller steps too
};

inline constexpr double kNativeWork = 1.0;
inline constexpr double kLadderWork = 20.0;  // of the ladder of modes, in these units

// Why MuJoCo's cone cannot be run, the rest of a sentence that begins with "its cone"; empty: it
// can. own: a machine of the user's own, whose pairs may be any number.
std::string cone_refusal(const scene::Scene& scene, bool own);

// Native, then MuJoCo with the contact model that decides, then with the others.
std::vector<Contestant> contestants(const scene::Scene& scene, const CompareOptions& options);

// Runs engines and keeps count of the work for the progress bar. Several threads may run at a time
// while a MujocoInPlace lives.
class Runner {
 public:
  // `total`: of all the work to come, in the units of Contestant::work. All must outlive it.
  Runner(const scene::Scene& scene, const CompareOptions& options, double total)
      : scene_(scene), options_(options), total_(total) {}

  Trajectory run(const Engine& engine, RunRequest request, double work, const std::string& what);
  // A run with the rows that plots and residuals need, and its figures.
  Side shown(const Contestant& who, RunRequest request);
  // Of `parameters` those that every comparison has are filled in.
  Twins twins(const Contestant& who, const Trajectory& original, double threshold,
              TwinParameters parameters);
  // For the time alone: as far as `end` (s), with no row but the last.
  Trajectory timed(const Contestant& who, double end,
                   std::shared_ptr<const CommandRecord> commands);
  // What the modes kept leave out; the twins' spread is what no more modes can tell.
  ModelError model_error(const Repeatability& repeats);
  // For work beside runs: tells its share, 1 at the end.
  std::function<void(double)> part(double work, const std::string& what);
  bool interrupted() const { return options_.interrupt && options_.interrupt->load(); }
  const scene::Scene& scene() const { return scene_; }

 private:
  Trajectory run(const scene::Scene& scene, const Engine& engine, RunRequest request, double work,
                 const std::string& what);

  const scene::Scene& scene_;
  const CompareOptions& options_;
  double total_;
  std::mutex mutex_;
  double done_ = 0.0;  // of total_
};

// Rung 0 is the scene's step, 1 and 2 are half and a quarter of it.
inline constexpr std::size_t kRungs = 3;
struct Rung {
  Metrics metrics;
  std::string failed = "there is no run at a smaller step";  // why there are none; empty: there are
};
using Ladder = std::array<Rung, kRungs>;  // [0] is not used: the side has its figures

// A run at a part of the scene's step, with what else it is asked for.
Rung run_rung(Runner& runner, const Contestant& who, std::size_t rung, RunRequest request);

// What decides whether the change of a figure with the step matters.
struct StepTest {
  const Metrics& native;        // at the scene's step
  double tolerance;             // of the comparison, a share
  std::vector<double> scatter;  // as figures(), shares (single_run_intervals)
};
// Whether a run at a quarter of the step is worth its time. It is not if the change from the whole
// to half the step is, for every judged figure, within its scatter, or negligible beside the
// tolerance or beside the difference between MuJoCo and native.
bool needs_quarter(const Side& side, const Rung& half, const StepTest& test);
// Fills side.limits: the figures at dt, dt/2 and dt/4 and their limits. If dt/4 was not needed, the
// limits come from the first two.
void set_limits(const Ladder& ladder, const StepTest& test, Side& side);
// Fills them where nothing was run at smaller steps.
void leave_limits(const std::string& reason, Side& side);

// The end of the timed runs: the smallest multiple of an eighth of the run up to which the share of
// contact is, for every side, about the same as over the whole run.
double timed_end(const scene::Run& run, const std::vector<Side>& sides);

// Passes for time alone, engines in turn so that a slow spell of the machine meets all of them.
// `commands`: of the native side.
void time_runs(Runner& runner, const std::vector<Contestant>& all, int repeats,
               std::shared_ptr<const CommandRecord> commands, std::vector<Side>& sides);

// Replay: the commands of a MuJoCo run on tape, for native runs that are driven by them.

// Whether a controller of the scene commands its actuator: without one there is nothing to replay,
// and replay equals lockstep.
bool has_commands(const scene::Scene& scene);

// Records the commands of the actuators over a run, each command from when it acts to the next one.
class CommandTape {
 public:
  // For one run; the tape must outlive it.
  StepWatch watch() {
    return [this](const WatchedStep& step) { add(step); };
  }
  void add(const WatchedStep& step) { record_->add(step.command_begin, step.command); }
  std::shared_ptr<const CommandRecord> record() const { return record_; }

 private:
  std::shared_ptr<CommandRecord> record_ = std::make_shared<CommandRecord>();
};

// How well a replay at the scene's step can repeat a run at all: the commands of the native stepper
// `verlet`, which closes its own loop, given to native `event`, against `event` in its own loop.
// They share model and law; what they differ by is what the open loop makes of the commands' step
// error, and an unstable one makes much of it. |deviation| of each figure, as figures(); 0 where
// verlet does not run the scene, or where coils lag, whose commands a run does not keep.
std::vector<double> replay_floor(Runner& runner, const scene::Scene& scene);

// The native stepper at MuJoCo's step, beside the reference and MuJoCo: its error comes from the
// step, any further error of MuJoCo from the contact model. `rigid` of a modal chain takes this
// very step in MuJoCo, so that its agreement with the shadow is no evidence.
//
// It is the plugin's shadow (plugin/shadow.h): the stepping of `verlet`, from the same start, one
// step a MuJoCo step. Where a controller commands the actuator, it is driven by the commands that
// MuJoCo's were given in the run that decides; the plugin's own shadow closes its own loop there.
// `native`: the column that it stands beside. `commands`: null without a controller.
ShadowColumn shadow_column(Runner& runner, const Side& native,
                           std::shared_ptr<const CommandRecord> commands,
                           const CompareOptions& options);

}  // namespace rotorub
