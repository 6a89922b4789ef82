// A user's own machine in any pose, and MuJoCo's results there: its mass matrix, its smooth forces,
// the places of the contacts' geoms and their Jacobians. The axes are those of the first ring's
// geom at qpos0.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <memory>

#include "plugin/model/config.h"

namespace rotorub::plugin {

class Probe {
 public:
  // m must outlive it. `start`: the state that supplies controls and activations. Throws
  // ConfigError if there is no memory.
  Probe(const mjModel* m, const Config& config, const mjData* start);

  // Sets the pose qpos0 moved by q (nv tangent coordinates), at rest.
  void pose(const Eigen::VectorXd& q);

  Eigen::MatrixXd mass() const;  // nv x nv, including armatures
  // All forces except those of constraints and contacts, at the velocities v; nv values, N and N m.
  Eigen::VectorXd force(const Eigen::VectorXd& v);

  // m, from the centre of a contact's ring to its rotor's.
  Eigen::Vector2d apart(const ContactPair& pair) const;

  // 6 x nv: translation of a geom's centre, then its rotation.
  Eigen::MatrixXd geom_jacobian(int geom) const;

  // 1 if the z axis of a ring's geom agrees with the z axis here, -1 if it is opposite.
  double along_axis(int geom) const;

 private:
  struct Delete {
    void operator()(mjData* d) const { mj_deleteData(d); }
  };

  Eigen::Vector3d place(int geom) const;

  const mjModel* m_;
  std::unique_ptr<mjData, Delete> d_;
  Eigen::Matrix3d axes_;  // rows: x, y, z in world coordinates
};

// The joints of a user's own machine that turn rotor and rings about the contacts' axis.

// A hinge about the z axis of the first ring's geom.
struct AxisJoint {
  int dof = -1;        // its degree of freedom; -1: none
  double sense = 1.0;  // -1 if its axis is opposite to z
};

// find_spin: the rotor's hinge, the same at all contacts. find_ring_turn: the hinge of one
// contact's ring. Both throw ConfigError, with the name of the joint, for a joint that turns its
// body in any way other than a single hinge about the axis through its centre, that turns the axes
// of the body's other joints, or that turns both bodies. The probe is then again at qpos0.
AxisJoint find_spin(const mjModel* m, const Config& config, Probe& probe);
AxisJoint find_ring_turn(const mjModel* m, const ContactPair& pair, Probe& probe);

}  // namespace rotorub::plugin
