// Contact model `rigid` in contact space (contact_space.h), for segments, models of the user's own
// and several contacts of the modal chain (its only contact has the native step, verlet.h): the
// contacts of one pass. A contact by itself is solved in closed form, (12)-(19), those that move
// together as one problem (coupled_step.h), either with the constraints of MuJoCo's solver that act
// on the same bodies (constraint_probe.h).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Those of the pairs that are rigid. In mjcb_control; adds their impulses to d->qfrc_passive, as
// forces over the step, and notes them (contact_memory.h).
void apply_rigid(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
