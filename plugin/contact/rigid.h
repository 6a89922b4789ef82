// Contact model `rigid`: the native model's set-valued contact (rigid_law.h), solved inside
// MuJoCo's step and applied as a force over it. MuJoCo's solver has no part in it: the pair's
// contact, there for viewers and for sensors, makes no constraint (its gap keeps it out).
//
// The step's velocity change without contact is h H^-1 f of MuJoCo's own forces (passive, bias,
// actuators, applied) and of its integrator's matrix H = M + h D. Impulses p give the change
// H^-1 J^T p in lasting contact and M^-1 J^T p at an impact, which takes no time; MuJoCo is handed
// the force that gives it.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/coordinates.h"

namespace rotorub::plugin {

// Adds the contact's force to d->qfrc_passive and sets the userdata entries of the contact. Called
// in mjcb_control, after the command has been written. Repeated calls at one time give the same.
// mju_error for RK4: impulses are once a step, and its four stages are not.
void apply_rigid(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// The mju_error.
void refuse_runge_kutta(const mjModel* m);

}  // namespace rotorub::plugin
