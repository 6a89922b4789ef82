// A whole native run: model, integrator, recorder.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "native_model/control/command_record.h"
#include "native_model/event/parameters.h"
#include "native_model/scene/forward.h"
#include "native_model/scene/run.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct NativeOptions {                              // overrides of the scene
  std::optional<scene::Integrator> integrator;      // default: the scene's
  std::optional<double> step;                       // s, default: the scene's
  std::optional<std::vector<double>> output_times;  // s, default: the scene's
  std::function<void(double)> progress;             // fraction done, called from time to time
  const std::atomic<bool>* interrupt = nullptr;     // set to true: stop and keep the results so far
  // Commands of another run, used instead of the scene's controller; null: none.
  std::shared_ptr<const CommandRecord> commands;
  // Parameters of `event`. Default: the bins of the mean force are as wide as the step, and the
  // rest is as in parameters.h.
  std::optional<EventParameters> event;
};

// Throws scene::SceneError if the requested integrator cannot run the scene.
Trajectory run_native(const scene::Scene& scene, const NativeOptions& options = {});

}  // namespace rotorub
