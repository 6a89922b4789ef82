// Whether rotor and ring move against each other along the ring's axis. Then the contact slips in
// two directions, along the ring's circle and along its axis,
//   gdot_Z = z' + r (e_r,y omega_x - e_r,x omega_y),
// z' of the rotor's centre against the point of the ring's axis beside it, omega the tilt rate of
// the rotor less 1 + delta / r times that of the ring: the motion of the point that touches; and
// friction opposes both together (contact/disc_law.h).
//
// A machine whose centres stay in the contact plane has the planar law: a rotor that only tilts,
// about a point of the axis, slips along it by the tilt rate times r, which linear rotor dynamics
// leaves out.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "plugin/config.h"

namespace rotorub::plugin {

// With friction, and a joint that moves the rotor's centre, or the ring, along the axis, by a lever
// of more than a clearance where it is a hinge. Looked at in qpos0.
bool slides_along_axis(const mjModel* m, const ContactPair& pair);

// W_Z in the space of BodyRows::kAxis: gdot_Z of its rates, and the load of a friction of 1 along
// the axis.
inline Eigen::Vector3d axial_column(const Eigen::Vector2d& e_r, double radius) {
  return {1.0, radius * e_r.y(), -radius * e_r.x()};
}

// The axis of a round rotor (cylinder, capsule; other shapes have none) is tilted from its ring's
// by 60 degrees or more in qpos0: it lies in it as no disc does.
bool lies_across(const mjModel* m, const ContactPair& pair);

}  // namespace rotorub::plugin
