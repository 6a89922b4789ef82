// How a rotor and its ring can move against each other, and do.
//
// Where they move against each other along the ring's axis, the contact slips in two directions,
// along the ring's circle and along its axis,
//   gdot_Z = z' + r (e_r,y omega_x - e_r,x omega_y),
// z' of the rotor's centre against the point of the ring's axis beside it, omega the tilt rate of
// the rotor less 1 + delta / r times that of the ring: the motion of the point that touches; and
// friction opposes both together (native_model/contact/disc_law.h).
//
// A machine whose centres stay in the contact plane has the planar law: a rotor that only tilts,
// about a point of the axis, slips along it by the tilt rate times r, which linear rotor dynamics
// leaves out.
#pragma once

#include <mujoco/mujoco.h>

#include "native_model/contact/kinematics.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// With friction, and a joint that moves the rotor's centre, or the ring, along the axis, by a lever
// of more than a clearance where it is a hinge. Looked at in qpos0.
bool slides_along_axis(const mjModel* m, const ContactPair& pair);

// The axis of a round rotor (cylinder, capsule; other shapes have none) is tilted from its ring's
// by 60 degrees or more in qpos0: it lies in it as no disc does.
bool lies_across(const mjModel* m, const ContactPair& pair);

// Gap, rates and slip of the state. After MuJoCo's velocity stage.
ContactPoint contact_point_of(const ContactPair& pair, const mjModel* m, const mjData* d);

// Whether the rotor can come to the ring within the step at all: a bound that needs neither
// Jacobians nor the contact's own matrix. Nearly every step of a flight ends here. For the contacts
// of a pass, one after the other; what loads and constraints can change is found once, where one of
// them asks. After update_smooth_force.
class Reach {
 public:
  Reach(const mjModel* m, mjData* d) : m_(m), d_(d) {}

  // False: not in this step, whatever the loads and constraints do, but for other contacts of ours.
  //
  // In the metric of M the loads change the velocities by at most h |f|, |f|^2 = f^T M^-1 f, and
  // MuJoCo's constraints, which minimise |a - a_smooth|^2 / 2 + s(J a - aref), by h sqrt(2 s(J
  // a_smooth - aref)), 2 s <= sum of D_i (J a_smooth - aref)_i^2. A point of a body of mass m_b and
  // least inertia I_b moves by no more than sqrt(1 / m_b + r^2 / I_b) times that, r from its centre
  // of mass.
  bool may_reach(const ContactPair& pair);

 private:
  const mjModel* m_;
  mjData* d_;
  double change_ = -1.0;  // in the metric of M, per second; < 0: not known yet
};

}  // namespace rotorub::plugin
