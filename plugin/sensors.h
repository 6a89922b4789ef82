// The user sensors of a generated model, so that any viewer can plot them.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

// Fills those of the stage (mjSTAGE_POS, mjSTAGE_VEL, mjSTAGE_ACC). For a user sensor of the last
// one MuJoCo first computes the forces between bodies, a tenth of a small model's step: `rigid`
// knows its forces in mjcb_control already, fills them there, and its files ask for "vel".
void fill_sensors(const Config& config, const mjModel* m, mjData* d, int stage);

}  // namespace rotorub::plugin
