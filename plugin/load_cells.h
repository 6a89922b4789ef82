// MuJoCo's own sensors of force beside a contact whose force is the plugin's: all of `rigid`, the
// friction of `coulomb`. For MuJoCo they are forces on joints (qfrc_passive). What bodies hand on
// to each other,
//   cfrc_int = sum over the subtree of (I a + v x I v) - cfrc_ext,
// has them only once they are external forces of rotor and ring, and so have the sensors that are
// made of it: force and torque of every site on a body that carries one of the two, in the site's
// frame. A touch sensor on either gets the normal force of `rigid`. They are corrected at the end
// of MuJoCo's acceleration stage, in mjcb_sensor, or where no user sensor has that called, by the
// preloaded library (register.cc).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Sets config.cells. Throws ConfigError for a sensor that would read wrong: MuJoCo's contact
// sensors, those with a history, and all where neither of the two above is.
void map_load_cells(const mjModel* m, Config& config);

// After MuJoCo's own sensors of the pass in which the contact was solved.
void fill_load_cells(const Config& config, const mjModel* m, mjData* d);

// The preloaded library stands behind mj_sensorAcc.
void stand_behind_sensors();

}  // namespace rotorub::plugin
