// The plugin's work in a forward pass, called by its callbacks (callbacks.cc), in this order:
//
//   collide_pair()    mjCOLLISIONFUNC  MuJoCo's contact of a pair, an exact disc in a ring
//   passive_pass()    mjcb_passive     the scene's loads, into qfrc_passive
//   control_pass()    mjcb_control     the scene's command, into ctrl; the contacts of all models
//                                      (contact/pairs.h, on the modal chain with `rigid`
//                                      contact/verlet.h), as forces in qfrc_passive; then MuJoCo
//                                      solves its constraints
//   magnet_answers()  mjcb_act_*       the force of an actuator with magnets
//   sensor_pass()     mjcb_sensor      the user sensors, after each stage of MuJoCo
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/actuators.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

void passive_pass(const mjModel* m, mjData* d);
void control_pass(const mjModel* m, mjData* d);
void sensor_pass(const mjModel* m, mjData* d, int stage);

// True, with the value, for actuators of the plugin.
bool magnet_answers(ActuatorQuestion asked, const mjModel* m, const mjData* d, int id,
                    mjtNum& value);

// True, with the number of contacts, for a contact pair of the plugin.
bool collide_pair(const mjModel* m, const mjData* d, CollisionContact* con, int g1, int g2,
                  int& count);

}  // namespace rotorub::plugin
