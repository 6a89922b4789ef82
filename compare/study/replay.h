// Replay: the commands of a MuJoCo run on tape, for native runs that are driven by them.
#pragma once

#include <memory>

#include "compare/engine/step_watch.h"
#include "native_model/control/command_record.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// Whether a controller of the scene commands its actuator: without one there is nothing to replay,
// and replay equals lockstep.
bool has_commands(const scene::Scene& scene);

// Records what the actuators are told over a run, each command from when it acts to the next one.
class CommandTape {
 public:
  // For one run; the tape must outlive it.
  StepWatch watch();
  void add(const WatchedStep& step) { record_->add(step.command_begin, step.command); }
  std::shared_ptr<const CommandRecord> record() const { return record_; }

 private:
  std::shared_ptr<CommandRecord> record_ = std::make_shared<CommandRecord>();
};

}  // namespace rotorub
