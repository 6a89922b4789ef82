// Contact model `cone`: MuJoCo's own soft contact with its friction cone, elliptic or a pyramid, as it is. Only
// where the spin is held constant and so is no degree of freedom, the slip that it does not see,
// r Omega, is put into the reference of the tangential rows.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

// Called in mjcb_control.
void apply_cone(const Config& config, const mjModel* m, mjData* d, const mjContact& contact);

}  // namespace rotorub::plugin
