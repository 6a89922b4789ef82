// Contact model `rigid` (rigid_law.h) on the segment rotor, whose mass matrix is MuJoCo's own.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/coordinates.h"

namespace rotorub::plugin {

// Adds the step's impulses to d->qfrc_passive, as forces over the step. Called in mjcb_control,
// after the command has been written.
void apply_segment_rigid(const Config& config, const mjModel* m, mjData* d,
                         const Coordinates& state);

}  // namespace rotorub::plugin
