// MuJoCo's own force sensors for a contact whose force comes from the plugin: the whole force of
// `rigid`, the friction of `coulomb`. For MuJoCo these are forces on joints (qfrc_passive). The
// forces between bodies,
//   cfrc_int = sum over the subtree of (I a + v x I v) - cfrc_ext,
// include them only if they are entered as external forces of rotor and ring. The sensors that use
// cfrc_int then include them too: force and torque of every site on a body that carries rotor or
// ring, in the site's frame. A touch sensor on either receives the normal force of `rigid`. The
// sensors are corrected at the end of MuJoCo's acceleration stage, in mjcb_sensor, or by the
// preloaded library (register.cc) if no user sensor causes MuJoCo to call mjcb_sensor there.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Sets config.cells and cells_in_callback. Throws ConfigError for a sensor that would show a wrong
// value: MuJoCo's contact sensors, sensors with a history, and all force sensors if they can be
// corrected in neither of the two ways above.
void map_load_cells(const mjModel* m, Config& config);

// Call it after MuJoCo's own sensors, in the pass in which the contact was solved.
void fill_load_cells(const Config& config, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
