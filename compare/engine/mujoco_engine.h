// A whole run in MuJoCo with the plugin linked in: the scene's MJCF is written, compiled and
// stepped, and every step is handed to the recorder that the native side uses.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "compare/engine/step_watch.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct MujocoOptions {
  std::optional<scene::ContactModel> contact;       // default: the scene's
  std::optional<double> step;                       // s, > 0, default: the scene's
  std::optional<std::vector<double>> output_times;  // s, ascending, default: the scene's
  double window = 0.0;                   // s, of impulses (impulse_window.h); 0: of the step
  std::function<void(double)> progress;  // fraction done, called now and then
  const std::atomic<bool>* interrupt = nullptr;  // set to true: stop, keep what there is
  StepWatch watch;                               // called after every step, if any
};

// The plugin builds its native model from scene.text: a scene that was changed after reading must
// have had its text changed too ([run] and [initial] apart). Throws std::invalid_argument for a
// scene without text and for what MuJoCo is not offered for (see mjcf()), std::runtime_error for
// what MuJoCo refuses. A run that fails has a status; what was recorded until then is kept.
// wall_s is the time in mj_step and in copying its results, without the recorder.
// Not from two threads at a time: MuJoCo's callbacks and message handlers are global.
Trajectory run_mujoco(const scene::Scene& scene, const MujocoOptions& options = {});

}  // namespace rotorub
