// The user sensors of generated and of users' own models, which any viewer can plot.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/contact/relative_motion.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// Writes rotorub_active: 1 if loads and contact were included in the present pass, else 0.
void mark_active(const Config& config, mjData* d, bool acts);

// Fills the sensors of the stage (mjSTAGE_POS, mjSTAGE_VEL, mjSTAGE_ACC). For user sensors of the
// last two stages MuJoCo first computes the momenta of subtrees and the forces between bodies; each
// costs a tenth of a small model's step. Therefore generated files ask for "pos" if possible:
// mjcb_passive fills the sensors that belong to the velocities, and mjcb_control fills the forces
// of `rigid`, which are known then.
void fill_sensors(const Config& config, const mjModel* m, mjData* d, int stage);

// For sensors that ask for another stage than the one in which MuJoCo could know them, and for the
// forces of a user's own model except those of `cone`, which MuJoCo's solver finds later: fills
// them in mjcb_control, whatever stage they ask for.
void fill_sensors_in_control(const Config& config, const mjModel* m, mjData* d, PassMotion& motion);

// Fills the sensors again that were filled before MuJoCo's last sensor stage: newer MuJoCo sets the
// user sensors of a stage to 0 before it calls mjcb_sensor.
void refill_sensors(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
