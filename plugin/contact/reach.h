// Whether the rotor can come to the ring within the step at all: a bound that needs neither
// Jacobians nor the contact's own matrix. Nearly every step of a flight ends here.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "native_model/contact/kinematics.h"
#include "plugin/config.h"
#include "plugin/contact/body_space.h"

namespace rotorub::plugin {

// Rates of the rotor's centre seen from the ring, (relative x, relative y, spin) as in
// body_space.h: J qvel, from MuJoCo's body velocities. After its velocity stage.
Eigen::Vector3d rates_of(const ContactPair& pair, const ContactPlace& place, const mjModel* m,
                         const mjData* d);
// Gap, rates and slip of the state.
ContactPoint contact_point_of(const ContactPair& pair, const mjModel* m, const mjData* d);

// The bound for the contacts of a pass, one after the other; what loads and constraints can change
// is found once, where one of them asks. After update_smooth_force.
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
