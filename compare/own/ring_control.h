// A controller on a user's own machine (own_machine.h): finds the actuators that push the ring and
// gives them the law's commands at each step, as a program around the model would.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"
#include "native_model/model/actuation.h"
#include "native_model/scene/scene.h"
#include "plugin/model/config.h"

namespace rotorub {

// The actuators of the first contact's ring; the axes are x and y of its geom.
struct RingActuators {
  int control[2] = {-1, -1};                    // indices in mjData.ctrl, for x and y
  Eigen::Vector2d force_per_control{1.0, 1.0};  // N per unit of ctrl, on the ring
  // N, on each of the native model's two axes at 45 degrees. No ctrlrange cuts a force within this
  // limit, so both sides apply the same force. |F_x| + |F_y| <= sqrt(2) force_limit.
  double force_limit = scene::Actuator().force_limit;
};

// Finds the two actuators by their forces at rest in qpos0. Throws std::runtime_error that names
// what is missing or does not fit.
RingActuators ring_actuators(const mjModel* m, const plugin::Config& config);

// The [controller] table made by these overrides (scene/overrides.h). The default sample_time is
// given in s. Throws scene::SceneError.
scene::Controller controller_of(const std::vector<std::string>& overrides, double sample_time);

// Evaluates the controller of model.first() at its samples, from MuJoCo's state at the start of the
// step, and holds the command in between.
class RingControl {
 public:
  RingControl(std::shared_ptr<const Model> model, ReadState read, const RingActuators& actuators);

  // Call before each mj_step: sets ctrl and returns the force on the ring, N, in the fixed frame.
  // Throws ControllerError.
  Eigen::Vector2d operator()(mjData* d);

 private:
  std::shared_ptr<const Model> model_;
  ReadState read_;
  RingActuators actuators_;
  SampledCommand command_;
  double sample_ = -1.0;  // number of the current sample
  Eigen::Vector2d force_{0.0, 0.0};
};

}  // namespace rotorub
