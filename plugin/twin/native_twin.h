// A native model of a user's own machine (own/own_config.h), made from mjModel alone: the rotor's
// modes, its ring (which may turn), drive, unbalance and loads, linear about the pose of qpos0.
// Contact and contact laws are those under the plugin's names. With it a machine can be
// cross-validated without a scene file.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "native_model/scene/scene.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

struct NativeTwin {
  // Input for `prepare`: rotor.assembled, stator, drive, forces, contact, and the initial state. In
  // its `run` only the step is filled.
  scene::Scene scene;

  // Native coordinates from MuJoCo's: coordinates (qpos - qpos0) + offset, with tangent vectors;
  // the rates have no offset. nq x nv, nq.
  Eigen::MatrixXd coordinates;
  Eigen::VectorXd offset;
  void read(const mjModel* m, const mjData* d, double* q, double* v) const;

  // Parts of the machine that the twin does not have, or holds constant although they are not; as
  // sentences.
  std::vector<std::string> limits;
};

// `start`: the state at t = 0, whose controls are held. Throws ConfigError, with the name of the
// part, if a twin cannot represent something, and scene::SceneError for a start outside the ring.
NativeTwin make_native_twin(const mjModel* m, const Config& config, const mjData* start);

}  // namespace rotorub::plugin
