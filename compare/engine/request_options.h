// A request to an engine as the options of a run.
#pragma once

#include <stdexcept>

#include "compare/engine/engine.h"
#include "compare/engine/mujoco_engine.h"

namespace rotorub {

// What all runs have: step, rows, progress, interrupt.
template <typename Options>
Options options_of(const RunRequest& request) {
  Options options;
  options.step = request.step;
  options.output_times = request.output_times;
  options.progress = request.progress;
  options.interrupt = request.interrupt;
  return options;
}

// Throws std::invalid_argument for commands.
inline MujocoOptions mujoco_options(const RunRequest& request) {
  if (request.commands) throw std::invalid_argument("MuJoCo takes no recorded commands");
  auto options = options_of<MujocoOptions>(request);
  options.watch = request.watch;
  return options;
}

}  // namespace rotorub
