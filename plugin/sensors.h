// The user sensors of a generated model, so that any viewer can plot them.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Fills those of the stage (mjSTAGE_POS, mjSTAGE_VEL, mjSTAGE_ACC). For a user sensor of the last
// two MuJoCo first computes the momenta of subtrees and the forces between bodies, each a tenth of
// a small model's step. So generated files ask for "pos" where they can: mjcb_passive fills what
// belongs to the velocities, and with `rigid`, who knows its forces then, mjcb_control the forces.
// rotorub_active: 1 where the pass that is under way has had its loads and its contact.
void mark_active(const Config& config, mjData* d, bool acts);

void fill_sensors(const Config& config, const mjModel* m, mjData* d, int stage);

// Of a user's own model, in mjcb_control: whatever stage they ask for, they are filled in this
// pass. (The forces of `cone`, which MuJoCo's solver finds after this, at mjSTAGE_ACC again.)
void fill_sensors_in_control(const Config& config, const mjModel* m, mjData* d);

// What was filled in before MuJoCo's last sensor stage, again: MuJoCo of today sets the user
// sensors of a stage to 0 before it calls mjcb_sensor.
void fill_late_sensors(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
