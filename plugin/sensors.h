// The user sensors of a generated model, so that any viewer can plot them.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

// Fills those of the stage (mjSTAGE_POS, mjSTAGE_VEL, mjSTAGE_ACC).
void fill_sensors(const Config& config, const mjModel* m, mjData* d, int stage);

}  // namespace rotorub::plugin
