// MuJoCo's reports of a contact's force, with the plugin's forces in them: alone they have 0 for
// `rigid` and no friction for `coulomb` (load_cells.h).
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// As mj_contactForce (`plain`), with the plugin's forces: along the contact's frame, on geom 2, N.
// The preloaded library answers mj_contactForce so.
void contact_force(const mjModel* m, const mjData* d, int id, mjtNum result[6],
                   void (*plain)(const mjModel*, const mjData*, int, mjtNum*) = mj_contactForce);

// As mj_rnePostConstraint (`plain`), with the plugin's forces in cfrc_ext and cfrc_int, after
// mj_forward or mj_step. The preloaded library answers mj_rnePostConstraint so.
void rne_post_constraint(const mjModel* m, mjData* d,
                         void (*plain)(const mjModel*, mjData*) = mj_rnePostConstraint);

}  // namespace rotorub::plugin
