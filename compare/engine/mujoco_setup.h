// What a run in MuJoCo starts from, whoever wrote the model.
#pragma once

#include <functional>
#include <memory>

#include "compare/engine/mujoco_engine.h"
#include "compare/engine/mujoco_model.h"
#include "native_model/scene/scene.h"
#include "native_model/system/model.h"
#include "plugin/config.h"

namespace rotorub {

// The state in the coordinates of a native model, nq values each.
using ReadState = std::function<void(const mjData* d, double* q, double* v)>;

struct MujocoSetup {
  MujocoModel m;
  std::unique_ptr<const plugin::Config> config;
  std::shared_ptr<const Model> model;  // that the run is recorded by
  ReadState read;
  std::string refusal;          // of the step; empty: none
  std::shared_ptr<void> keeps;  // what of m is not its own
};

// scene: its [run], contact model and name are those of the run.
Trajectory run_mujoco(const scene::Scene& scene, const MujocoSetup& setup,
                      const MujocoOptions& options);

}  // namespace rotorub
