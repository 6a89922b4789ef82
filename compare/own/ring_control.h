// A controller on a machine of the user's own (own_machine.h): which of its actuators push the
// ring, and the law's commands to them, step by step as a program around the model gives them.
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

// Of the first contact's ring; axes are x and y of its geom.
struct RingActuators {
  int control[2] = {-1, -1};                    // in mjData.ctrl, of x and y
  Eigen::Vector2d force_per_control{1.0, 1.0};  // N a unit of ctrl, on the ring
  // N, on each of the native model's two axes at 45 degrees: within it no ctrlrange cuts anything
  // off, and both sides are given one force. |F_x| + |F_y| <= sqrt(2) of it.
  double force_limit = scene::Actuator().force_limit;
};

// The two that push it, found by their forces at rest in the pose of qpos0. Throws
// std::runtime_error naming what is missing or does not fit.
RingActuators ring_actuators(const mjModel* m, const plugin::Config& config);

// The table [controller] that these overrides (scene/overrides.h) make, sampled every sample_time
// (s) unless they say otherwise. Throws scene::SceneError.
scene::Controller controller_of(const std::vector<std::string>& overrides, double sample_time);

// The law of model.first(), which must outlive no one: it is asked at its samples, shown MuJoCo's
// state as it stands at the begin of a step, and its command is held in between.
class RingControl {
 public:
  RingControl(std::shared_ptr<const Model> model, ReadState read, const RingActuators& actuators);

  // Before each mj_step: sets ctrl. Returns the force on the ring, N, fixed frame. Throws
  // ControllerError.
  Eigen::Vector2d operator()(mjData* d);

 private:
  std::shared_ptr<const Model> model_;
  ReadState read_;
  RingActuators actuators_;
  SampledCommand command_;
  double sample_ = -1.0;  // the number of the one that holds
  Eigen::Vector2d force_{0.0, 0.0};
};

}  // namespace rotorub
