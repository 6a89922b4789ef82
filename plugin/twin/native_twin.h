// A native model of a user's own machine (own/own_config.h), from mjModel alone: the rotor's modes,
// its ring (which may turn), drive, unbalance and loads, linear about the pose of qpos0; contact
// and laws are those of the plugin's names. The machine's cross-validation needs no scene file.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "native_model/scene/scene.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

struct NativeTwin {
  // `prepare` takes it: rotor.assembled, stator, drive, forces, contact, the start. Its run is not
  // filled but for the step.
  scene::Scene scene;

  // The native coordinates of MuJoCo's: coordinates (qpos - qpos0) + offset, as tangent vectors;
  // rates without the offset. nq x nv, nq.
  Eigen::MatrixXd coordinates;
  Eigen::VectorXd offset;
  void read(const mjModel* m, const mjData* d, double* q, double* v) const;

  // What of the machine the twin does not have, or holds for constant though it is not: sentences.
  std::vector<std::string> limits;
};

// `start`: the state of t = 0, whose controls are held. Throws ConfigError naming what cannot be in
// a twin, scene::SceneError for a start outside the ring.
NativeTwin make_native_twin(const mjModel* m, const Config& config, const mjData* start);

}  // namespace rotorub::plugin
