// MuJoCo's solver stops after <option iterations>, whether its answer fits or not. A contact of
// ours that it solves (`coulomb`, the cones, pairs that are corrected for sliding) then has a wrong
// force and sinks in. That is said once for each mjData.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Before the contacts of a pass are solved: warns if the solver gave up in the pass before, and a
// contact of ours was in it.
void watch_solver(const Config& config, const mjModel* m, mjData* d);

// After that: whether one is in it now.
void note_solved_contacts(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
