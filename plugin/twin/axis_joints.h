// The joints of a user's own machine that turn rotor and ring about the contact's axis, and the
// unbalance of what the rotor's turns.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <vector>

#include "plugin/config.h"
#include "plugin/twin/probe.h"

namespace rotorub::plugin {

// A hinge about the z axis of the ring's geom.
struct AxisJoint {
  int dof = -1;        // its degree of freedom; -1: none
  double sense = 1.0;  // -1: its axis is against z
};

// Those of rotor and ring. Both throw ConfigError naming a joint that turns its body otherwise than
// one hinge about the axis through its centre does, that turns the axes of the body's other joints,
// or both bodies. The probe comes back in the pose of qpos0.
AxisJoint find_spin(const mjModel* m, const Config& config, Probe& probe);
AxisJoint find_ring_turn(const mjModel* m, const Config& config, Probe& probe);

// An eccentric mass: the centre of mass of a body off the rotor's axis.
struct Eccentricity {
  Eigen::MatrixXd jacobian;  // 2 x nv: of the point of the axis beside it, in the contact's axes
  double static_moment;      // kg m
  double phase;              // rad, from the contact's x axis at spin angle 0
};

// Of all bodies that turn with the spin.
std::vector<Eccentricity> find_unbalance(const mjModel* m, const AxisJoint& spin,
                                         const Probe& probe);

}  // namespace rotorub::plugin
