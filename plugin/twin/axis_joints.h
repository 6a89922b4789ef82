// The joints of a user's own machine that turn rotor and rings about the contacts' axis.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/twin/probe.h"

namespace rotorub::plugin {

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
