// How a rotor and its ring can move and do move relative to each other.
//
// If they can move relative to each other along the ring's axis, the contact slips in two
// directions: along the ring's circle, and along its axis with
//   gdot_Z = z' + r (e_r,y omega_x - e_r,x omega_y).
// z' is the velocity of the rotor's centre against the nearest point of the ring's axis; omega is
// the tilt rate of the rotor minus 1 + delta / r times that of the ring. gdot_Z is thus the motion
// at the point of contact. Friction opposes both slips together (native_model/contact/disc_law.h).
//
// If the centres stay in the contact plane, the planar law applies. A rotor that only tilts about a
// point of the axis does slip along it, by the tilt rate times r, but linear rotor dynamics leaves
// this out.
#pragma once

#include <mujoco/mujoco.h>

#include "native_model/contact/kinematics.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// True if the contact has friction and a joint moves the rotor's centre or the ring along the axis;
// a hinge counts if its lever arm is longer than a clearance. Determined at qpos0.
bool slides_along_axis(const mjModel* m, const ContactPair& pair);

// True if the axis of a round rotor (cylinder, capsule; other shapes have none) is tilted from its
// ring's axis by 60 degrees or more at qpos0. A disc cannot lie in its ring like that.
bool lies_across(const mjModel* m, const ContactPair& pair);

// Gap, rates and slip of the state. Call it after MuJoCo's velocity stage.
ContactPoint contact_point_of(const ContactPair& pair, const mjModel* m, const mjData* d);

// Whether the rotor can reach the ring within the step at all, by a bound that needs neither
// Jacobians nor the contact's own matrix. Nearly every step of a flight ends here. It is used for
// the contacts of a pass, one after the other; the effect of loads and constraints is computed
// once, when it is first needed. Call it after update_smooth_force.
class Reach {
 public:
  Reach(const mjModel* m, mjData* d) : m_(m), d_(d) {}

  // False: the rotor does not reach the ring in this step by any loads and constraints, except
  // other contacts of the plugin.
  //
  // In the metric of M the loads change the velocities by at most h |f|, |f|^2 = f^T M^-1 f.
  // MuJoCo's constraints, which minimise |a - a_smooth|^2 / 2 + s(J a - aref), change them by at
  // most h sqrt(2 s(J a_smooth - aref)), where 2 s <= sum of D_i (J a_smooth - aref)_i^2. A point
  // at the distance r from the centre of mass of a body with the mass m_b and the least inertia I_b
  // moves by at most sqrt(1 / m_b + r^2 / I_b) times that.
  bool may_reach(const ContactPair& pair);

 private:
  const mjModel* m_;
  mjData* d_;
  double change_ = -1.0;  // change of the velocities per second in the metric of M; < 0: unknown
};

}  // namespace rotorub::plugin
