// Contact model `coulomb`: MuJoCo's frictionless soft contact, with Coulomb friction beside it. The
// contacts of one pass, together.
//
// Before MuJoCo solves its constraint, the normal force of this very step is solved together with
// friction, as one Coulomb problem in accelerations (no force of the step before is used):
//   y_N = G_NN l_N + G_NT l_T + gddot_free - a_ref,     0 <= l_N  _|_  y_N >= 0
//   y_T = G_TN l_N + G_TT l_T + slip_free / h,          |l_T| <= mu l_N, opposing y_T
// a_ref = -B gdot_N - K g_N is MuJoCo's reference; G and the free motion are those of the
// integrator's own matrix M + h D; gddot has the curvature v_t^2 / delta of the whirl, and
// slip_free is the slip that the step would end with. y_T = 0 is sticking: the force that just
// stops the slip, so that it does not flip its sign each step. Friction is then a passive force,
// and MuJoCo's reference is set such that its solver finds l_N: its regularisation (1e-4 of the
// force) and the damping it does not know are gone.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Of the pairs that are coulomb: their friction is added to d->qfrc_passive, and the references of
// their rows are set. Of those that are cone, the memory. In mjcb_control, after the command has
// been written.
void apply_coulomb(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
