// MuJoCo's functions for a contact's force, including the plugin's forces. MuJoCo alone returns 0
// for `rigid`, and no friction for `coulomb` (load_cells.h).
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// Like mj_contactForce (`plain`), including the plugin's forces: along the contact's frame, on geom
// 2, N. In the preloaded library mj_contactForce calls this function.
void contact_force(const mjModel* m, const mjData* d, int id, mjtNum result[6],
                   void (*plain)(const mjModel*, const mjData*, int, mjtNum*) = mj_contactForce);

// Like mj_rnePostConstraint (`plain`), including the plugin's forces in cfrc_ext and cfrc_int. Call
// it after mj_forward or mj_step. In the preloaded library mj_rnePostConstraint calls this
// function.
void rne_post_constraint(const mjModel* m, mjData* d,
                         void (*plain)(const mjModel*, mjData*) = mj_rnePostConstraint);

}  // namespace rotorub::plugin
