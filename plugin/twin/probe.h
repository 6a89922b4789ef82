// A user's own machine put into any pose, and what MuJoCo says of it there: its mass matrix, its
// smooth forces, where the geoms of the contact are and how they move. Axes are those of the ring's
// geom in the pose of qpos0.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <memory>

#include "plugin/config.h"

namespace rotorub::plugin {

class Probe {
 public:
  // m and config must outlive it. `start`: where controls and activations are taken from. Throws
  // ConfigError where there is no memory.
  Probe(const mjModel* m, const Config& config, const mjData* start);

  // qpos0 moved by q, nv tangent coordinates, at rest.
  void pose(const Eigen::VectorXd& q);

  Eigen::MatrixXd mass() const;  // nv x nv, armatures included
  // All forces but constraints and contacts, at velocities v; nv values, N and N m.
  Eigen::VectorXd force(const Eigen::VectorXd& v);

  Eigen::Vector2d apart() const;  // m, the rotor's centre from the ring's

  // 6 x nv: of a point that moves with the body, then of its rotation.
  Eigen::MatrixXd jacobian(const Eigen::Vector3d& world, int body) const;
  Eigen::MatrixXd geom_jacobian(int geom) const;  // of its centre

  const Eigen::Matrix3d& axes() const { return axes_; }  // rows: x, y, z in the world
  const mjData* data() const { return d_.get(); }

 private:
  struct Delete {
    void operator()(mjData* d) const { mj_deleteData(d); }
  };

  Eigen::Vector3d place(int geom) const;

  const mjModel* m_;
  const Config& config_;
  std::unique_ptr<mjData, Delete> d_;
  Eigen::Matrix3d axes_;
};

// Three of MuJoCo's numbers.
inline Eigen::Vector3d vector3(const mjtNum* x) { return {x[0], x[1], x[2]}; }

}  // namespace rotorub::plugin
