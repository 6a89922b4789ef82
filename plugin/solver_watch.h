// MuJoCo's solver stops after <option iterations> even if it has not converged. A contact of the
// plugin that it solves (`coulomb`, the cones, pairs that are corrected for sliding) then has a
// wrong force and sinks in. The user is warned once for each mjData.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Call it before the contacts of a pass are solved. It warns if the solver did not converge in the
// previous pass and solved a contact of the plugin there.
void watch_solver(const Config& config, const mjModel* m, mjData* d);

// Call it after that. It records whether the solver has such a contact in this pass.
void note_solved_contacts(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
