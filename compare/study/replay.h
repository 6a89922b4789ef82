// Replay: the commands of a MuJoCo run on tape, for native runs that are driven by them.
#pragma once

#include <memory>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/study/comparison_runs.h"
#include "native_model/control/command_record.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// Whether a controller of the scene commands its actuator: without one there is nothing to replay,
// and replay equals lockstep.
bool has_commands(const scene::Scene& scene);

// Records the commands of the actuators over a run, each command from when it acts to the next one.
class CommandTape {
 public:
  // For one run; the tape must outlive it.
  StepWatch watch();
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

}  // namespace rotorub
