// What the plugin does in a forward pass, behind MuJoCo's callbacks (callbacks.cc).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/actuators.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

void passive_pass(const mjModel* m, mjData* d);
void control_pass(const mjModel* m, mjData* d);
void sensor_pass(const mjModel* m, mjData* d, int stage);

// Of the actuators that are ours: true, and the value.
bool magnet_answers(ActuatorQuestion asked, const mjModel* m, const mjData* d, int id,
                    mjtNum& value);

// Of the contact pair: true, and the number of contacts.
bool collide_pair(const mjModel* m, const mjData* d, CollisionContact* con, int g1, int g2,
                  int& count);

}  // namespace rotorub::plugin
