// MuJoCo's report of a contact's force, with the plugin's forces in it: alone it has 0 for `rigid`
// and no friction for `coulomb` (load_cells.h).
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// As mj_contactForce (`plain`), with the plugin's forces: along the contact's frame, on geom 2, N.
// The preloaded library answers mj_contactForce so.
void contact_force(const mjModel* m, const mjData* d, int id, mjtNum result[6],
                   void (*plain)(const mjModel*, const mjData*, int, mjtNum*) = mj_contactForce);

}  // namespace rotorub::plugin
