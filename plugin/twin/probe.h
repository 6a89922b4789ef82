// A user's own machine put into any pose, and what MuJoCo says of it there: its mass matrix, its
// smooth forces, where the geoms of the contacts are and how they move. Axes are those of the first
// ring's geom in the pose of qpos0.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <memory>

#include "plugin/model/config.h"

namespace rotorub::plugin {

class Probe {
 public:
  // m must outlive it. `start`: where controls and activations are taken from. Throws
  // ConfigError where there is no memory.
  Probe(const mjModel* m, const Config& config, const mjData* start);

  // qpos0 moved by q, nv tangent coordinates, at rest.
  void pose(const Eigen::VectorXd& q);

  Eigen::MatrixXd mass() const;  // nv x nv, armatures included
  // All forces but constraints and contacts, at velocities v; nv values, N and N m.
  Eigen::VectorXd force(const Eigen::VectorXd& v);

  // m, the centre of a contact's rotor from its ring's.
  Eigen::Vector2d apart(const ContactPair& pair) const;

  // 6 x nv: of a geom's centre, then of its rotation.
  Eigen::MatrixXd geom_jacobian(int geom) const;

  // 1 where the z axis of a ring's geom is theirs, -1 where it is against it.
  double along_axis(int geom) const;

 private:
  struct Delete {
    void operator()(mjData* d) const { mj_deleteData(d); }
  };

  Eigen::Vector3d place(int geom) const;

  const mjModel* m_;
  std::unique_ptr<mjData, Delete> d_;
  Eigen::Matrix3d axes_;  // rows: x, y, z in the world
};

// The joints of a user's own machine that turn rotor and rings about the contacts' axis.

// A hinge about the z axis of the first ring's geom.
struct AxisJoint {
  int dof = -1;        // its degree of freedom; -1: none
  double sense = 1.0;  // -1: its axis is against z
};

// The rotor's, the same at all contacts, and that of one contact's ring. Both throw ConfigError
// naming a joint that turns its body otherwise than one hinge about the axis through its centre
// does, that turns the axes of the body's other joints, or both bodies. The probe comes back in the
// pose of qpos0.
AxisJoint find_spin(const mjModel* m, const Config& config, Probe& probe);
AxisJoint find_ring_turn(const mjModel* m, const ContactPair& pair, Probe& probe);

}  // namespace rotorub::plugin
