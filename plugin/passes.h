// What the plugin does in a forward pass, behind MuJoCo's callbacks (callbacks.cc).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

void passive_pass(const mjModel* m, mjData* d);
void control_pass(const mjModel* m, mjData* d);
void sensor_pass(const mjModel* m, mjData* d, int stage);

// Of the actuators that are ours: true, and the value.
bool magnet_gain_of(const mjModel* m, const mjData* d, int id, mjtNum& value);
bool magnet_bias_of(const mjModel* m, const mjData* d, int id, mjtNum& value);
bool coil_rate_of(const mjModel* m, const mjData* d, int id, mjtNum& value);

// Of the contact pair: true, and the number of contacts.
bool collide_pair(const mjModel* m, const mjData* d, CollisionContact* con, int g1, int g2,
                  int& count);

// False under mjDSBL_CONTACT or mjDSBL_CONSTRAINT: then `rigid` has none either.
inline bool contact_enabled(const mjModel* m) {
  return (m->opt.disableflags & (mjDSBL_CONTACT | mjDSBL_CONSTRAINT)) == 0;
}

}  // namespace rotorub::plugin
