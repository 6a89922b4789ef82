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

struct NativeOptions {                          // what a run may do otherwise than its scene says
  std::optional<scene::Integrator> integrator;  // default: the scene's
  std::optional<double> step;                   // s, default: the scene's
  std::optional<std::vector<double>> output_times;  // s, default: the scene's
  std::function<void(double)> progress;             // fraction done, called now and then
  const std::atomic<bool>* interrupt = nullptr;     // set to true: stop, keep what there is
  // Commands of another run in the place of the scene's controller; null: none.
  std::shared_ptr<const CommandRecord> commands;
  // Of `event`. Default: bins of the mean force as wide as the step, the rest as parameters.h has
  // it.
  std::optional<EventParameters> event;
};

// Throws scene::SceneError for a scene that the integrator asked for cannot run.
Trajectory run_native(const scene::Scene& scene, const NativeOptions& options = {});

}  // namespace rotorub
