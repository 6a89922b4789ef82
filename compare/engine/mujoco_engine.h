// A whole run in MuJoCo with the plugin linked in: writes and compiles the scene's MJCF, steps the
// model, and passes every step to the recorder that the native engines use.
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

// MuJoCo's callbacks and message handlers are global. They stay installed while an object of this
// class exists, so that runs may begin and end in any thread.
struct MujocoInPlace {
  MujocoMessages messages;
  plugin::Hooks hooks;
};

struct MujocoOptions : RunRequest {
  std::optional<scene::ContactModel> contact{};  // default: the scene's
  double window = 0.0;  // s, of the window impulse (trajectory/recorder.h); 0: kWindowSteps steps
};

// The plugin builds its native model from scene.text, so a scene that was changed after reading
// needs the same changes in its text ([run] and [initial] excepted). Throws std::invalid_argument
// for a scene without text, for scenes that mjcf() does not support and for recorded commands;
// std::runtime_error for what MuJoCo refuses. A run that fails has a status and keeps what was
// recorded until then. wall_s is the time in mj_step and in copying its results, without the
// recorder. Concurrent calls require that a MujocoInPlace exists.
Trajectory run_mujoco(const scene::Scene& scene, const MujocoOptions& options = {});

// Reads the state in the coordinates of a native model, nq values each.
using ReadState = std::function<void(const mjData* d, double* q, double* v)>;

// Everything that a run in MuJoCo starts from, for generated models and user models alike.
struct MujocoSetup {
  MujocoModel m;
  std::unique_ptr<const plugin::Config> config;
  std::shared_ptr<const Model> model;  // the model for the recorder
  ReadState read;
  std::string refusal;          // of the step; empty if it is accepted
  std::shared_ptr<void> keeps;  // owns data that m refers to
  // Called before each step: sets ctrl and returns the force on the ring, N. Empty if the plugin
  // controls the ring or nothing does. Throws ControllerError.
  std::function<Eigen::Vector2d(mjData*)> control;
};

// scene supplies the start, [run], the contact model and the name of the run.
Trajectory run_mujoco(const scene::Scene& scene, const MujocoSetup& setup,
                      const MujocoOptions& options);

}  // namespace rotorub
