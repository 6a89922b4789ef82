// The contact of two geoms among those of a forward pass.
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// Null: none, or not handed to the solver.
const mjContact* find_contact(int rotor_geom, int ring_geom, const mjData* d);

}  // namespace rotorub::plugin
