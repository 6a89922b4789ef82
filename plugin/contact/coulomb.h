// Contact model `coulomb`: MuJoCo's frictionless soft contact together with Coulomb friction, for
// all contacts of a pass.
//
// Before MuJoCo solves its constraints, the normal forces of the same step are solved together with
// friction, as one Coulomb problem in accelerations (no force of the previous step is used):
//   y_N = G_NN l_N + G_NT l_T + gddot_free - a_ref,     0 <= l_N  _|_  y_N >= 0
//   y_T = G_TN l_N + G_TT l_T + slip_free / h,          |l_T| <= mu l_N, opposing y_T
// a_ref = -B gdot_N - K g_N is MuJoCo's reference. G and the free motion belong to the matrix of
// the integrator, M + h D. gddot includes the curvature v_t^2 / delta of the whirl, and slip_free
// is the slip at the end of the step without a contact. y_T = 0 is sticking: the force just stops
// the slip, so that the slip does not change its sign in each step. Friction is then applied as a
// passive force, and MuJoCo's reference is set so that its solver finds l_N. This removes the
// errors by its regularisation (1e-4 of the force) and by the damping that it does not include.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/contact/relative_motion.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// Called by apply_command_and_contacts() (passes.cc) after the command has been written. For pairs
// of `coulomb`, adds the friction to d->qfrc_passive and sets the references of their rows. For
// pairs of the cones, updates the entries in userdata.
void apply_coulomb(const Config& config, const mjModel* m, mjData* d, PassMotion& motion);

}  // namespace rotorub::plugin
