// A whole run in MuJoCo with the plugin linked in: the scene's MJCF is written, compiled and
// stepped, and every step is handed to the recorder that the native side uses.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "compare/engine/engine.h"
#include "compare/engine/mujoco_model.h"
#include "native_model/model/model.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/hooks.h"
#include "plugin/model/config.h"

namespace rotorub {

// MuJoCo's callbacks and message handlers are global. While one of these lives they stay in place,
// so that runs may begin and end in any threads.
struct MujocoInPlace {
  MujocoMessages messages;
  plugin::Hooks hooks;
};

struct MujocoOptions : RunRequest {
  std::optional<scene::ContactModel> contact{};  // default: the scene's
  double window = 0.0;  // s, of impulses (trajectory/recorder.h); 0: of the step
};

// The plugin builds its native model from scene.text: a scene that was changed after reading must
// have had its text changed too ([run] and [initial] apart). Throws std::invalid_argument for a
// scene without text and for what MuJoCo is not offered for (see mjcf()), std::runtime_error for
// what MuJoCo refuses; std::invalid_argument for recorded commands. A run that fails has a status;
// what was recorded until then is kept.
// wall_s is the time in mj_step and in copying its results, without the recorder.
// From two threads at a time only while a MujocoInPlace lives.
Trajectory run_mujoco(const scene::Scene& scene, const MujocoOptions& options = {});

// The state in the coordinates of a native model, nq values each.
using ReadState = std::function<void(const mjData* d, double* q, double* v)>;

// What a run in MuJoCo starts from, whoever wrote the model.
struct MujocoSetup {
  MujocoModel m;
  std::unique_ptr<const plugin::Config> config;
  std::shared_ptr<const Model> model;  // that the run is recorded by
  ReadState read;
  std::string refusal;          // of the step; empty: none
  std::shared_ptr<void> keeps;  // what of m is not its own
  // Before each step: sets ctrl, and returns the force on the ring, N; empty: the plugin does, or
  // nobody. Throws ControllerError.
  std::function<Eigen::Vector2d(mjData*)> control;
};

// scene: its start, [run], contact model and name are those of the run.
Trajectory run_mujoco(const scene::Scene& scene, const MujocoSetup& setup,
                      const MujocoOptions& options);

}  // namespace rotorub
