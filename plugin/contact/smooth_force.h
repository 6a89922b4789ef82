// MuJoCo's generalised force without constraints, as it will be in the forward pass that is under
// way: mjcb_control is called before it is summed up.
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// Brings d->qfrc_actuator up to date with ctrl; of qfrc_smooth and qacc_smooth, what smooth_force
// needs.
void update_smooth_force(const mjModel* m, mjData* d);

// Of one degree of freedom: passive, bias, applied, actuators, and the bodies' xfrc_applied.
// After update_smooth_force.
inline double smooth_force(const mjData* d, int dof) { return d->qfrc_smooth[dof]; }

}  // namespace rotorub::plugin
