// Contact model `coulomb` (coulomb.h) on the segment rotor, whose mass matrix is MuJoCo's own.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/coordinates.h"

namespace rotorub::plugin {

// As apply_coulomb.
void apply_segment_coulomb(const Config& config, const mjModel* m, mjData* d,
                           const mjContact& contact, const Coordinates& state);

}  // namespace rotorub::plugin
