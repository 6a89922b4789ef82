// The runs of a comparison: the engines, their steps and their length.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/study/resync.h"
#include "compare/study/scene_comparison.h"
#include "compare/study/twins.h"
#include "native_model/control/command_record.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// Level 0 is the scene's step; levels 1 and 2 are one half and one quarter of it.
inline constexpr std::size_t kStepLevels = 3;
struct StepLevel {
  Metrics metrics;
  // The reason why there are no metrics; empty if there are.
  std::string failed = "there is no run at a smaller step";
};
using Ladder =
    std::array<StepLevel, kStepLevels>;  // [0] is unused, because the side holds its figures

// Records the actuator's commands over one run; each acts until the next one.
StepWatch recording(std::shared_ptr<CommandRecord> record);

// One engine of a comparison, and its runs.
struct ComparedEngine {
  std::string label;
  std::unique_ptr<Engine> engine;
  // Work of one run at the scene's step relative to a native run, for the progress bar.
  double work;
  bool climbs = true;              // whether it also runs at smaller steps
  Side* side = nullptr;            // its run that is shown
  ComparedModel* model = nullptr;  // null: native
  // The commands of its run on each level.
  std::array<std::shared_ptr<CommandRecord>, kStepLevels> commands{};
  Ladder ladder{}, native_ladder{};    // native: driven by the commands of its runs
  std::optional<OnsetWatch> onsets{};  // only in resync
};

inline constexpr double kNativeWork = 1.0;
inline constexpr double kLadderWork = 20.0;  // work of the ladder of modes, in the same unit

// The reason why MuJoCo's cone cannot run the scene, as the rest of a sentence that begins with
// "its cone"; empty if it can. own: the scene is the twin of a user's own machine, which may have
// any number of pairs.
std::string cone_refusal(const scene::Scene& scene, bool own);

// Native, then MuJoCo with the contact model that decides, then with the other models; without
// runs.
std::vector<ComparedEngine> compared_engines(const scene::Scene& scene,
                                             const CompareOptions& options);

// Runs engines and counts the work for the progress bar. While a MujocoInPlace exists, several
// threads may use it at a time.
class Runner {
 public:
  // total: all work to come, in the unit of ComparedEngine::work. The arguments must outlive this.
  Runner(const scene::Scene& scene, const CompareOptions& options, double total)
      : scene_(scene), options_(options), total_(total) {}

  Trajectory run(const Engine& engine, RunRequest request, double work, const std::string& what);
  // A run with the rows that plots and residuals need, and its figures.
  Side shown(const ComparedEngine& who, RunRequest request);
  // Fills in the values of `parameters` that are common to all comparisons.
  Twins twins(const ComparedEngine& who, double threshold, TwinParameters parameters);
  // A run up to `end` (s) for timing, which records only the last row.
  Trajectory timed(const ComparedEngine& who, double end,
                   std::shared_ptr<const CommandRecord> commands);
  // The error from the modes left out. Errors within the twins' spread cannot be resolved.
  ModelError model_error(const std::vector<FigureSample>& native);
  // Progress of work outside of runs: call the result with the fraction done, finally 1.
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

// Runs at the level's fraction of the scene's step, otherwise as requested.
StepLevel run_level(Runner& runner, const ComparedEngine& who, std::size_t level,
                    RunRequest request);

// Determines whether the change of a figure with the step matters.
struct StepTest {
  const Metrics& native;  // at the scene's step
  double tolerance;       // share, of the comparison
  // One share per figure, in the order of figures() (single_run_intervals).
  std::vector<double> scatter;
};
// True if a run at a quarter of the step is worth its time. It is not if the change from the whole
// to half the step is, for every judged figure, within its scatter, or negligible beside the
// tolerance or beside the difference between MuJoCo and native.
bool needs_quarter(const Side& side, const StepLevel& half, const StepTest& test);
// Sets side.limits: the figures at dt, dt/2 and dt/4 and their limits. If dt/4 was not needed, the
// limits come from the first two.
void set_limits(const Ladder& ladder, const StepTest& test, Side& side);
// Sets side.limits without runs at smaller steps, for that reason.
void leave_limits(const std::string& reason, Side& side);

// The end of the timed runs, s: the smallest multiple of an eighth of the run, of at least 10000
// steps, up to which every side's share of contact is within 0.1 of that over the whole run.
double timed_end(const scene::Run& run, const std::vector<const Side*>& sides);

// Timing runs. The engines take turns, so that a slow phase of the computer affects all of them.
// commands: for the native side.
void time_runs(Runner& runner, const std::vector<ComparedEngine>& all, int repeats,
               std::shared_ptr<const CommandRecord> commands);

// True if a controller of the scene commands its actuator. Without one there is nothing to replay,
// and replay equals lockstep.
bool has_commands(const scene::Scene& scene);

// The smallest difference that a replay at the scene's step can resolve. The commands of the native
// stepper `verlet` in its own closed loop drive native `event`, which is compared with `event` in
// its own closed loop. Model and law are the same, so the difference is the effect of the commands'
// step error in the open loop, which an unstable loop amplifies. One |deviation| per figure, in the
// order of figures(). All 0 if verlet does not run the scene, or if coils lag, because a run does
// not record their commands.
std::vector<double> replay_floor(Runner& runner, const scene::Scene& scene);

// The native stepper at MuJoCo's step, shown beside the reference and MuJoCo: its error comes from
// the time step, any further error of MuJoCo from the contact model. With the modal chain, `rigid`
// takes exactly this step in MuJoCo, so its agreement with the shadow is no evidence.
//
// It equals the plugin's shadow (plugin/shadow.h): the stepping of `verlet` from the same start,
// one step per MuJoCo step. If a controller commands the actuator, the commands of the MuJoCo run
// that decides drive it here, while the plugin's own shadow closes its own loop. native: the side
// that it is compared with. commands: null without a controller.
ShadowColumn shadow_column(Runner& runner, const Side& native,
                           std::shared_ptr<const CommandRecord> commands,
                           const CompareOptions& options);

}  // namespace rotorub
