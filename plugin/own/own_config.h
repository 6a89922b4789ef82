// A user's own MJCF, without a scene of ours: the contact of a rotor's geom in a ring's geom. Given
// in <custom>:
//   text     rotorub_rotor_geom, rotorub_ring_geom     names of the two geoms
//            rotorub_contact                           rigid (default) | coulomb | cone
//   numeric  rotorub_clearance                         m, > 0
//            rotorub_radius                            m, > 0; default: the rotor geom's size[0]
//            rotorub_friction, rotorub_restitution     mu >= 0; eps_N in [0, 1]; default 0
//            rotorub_tangential_restitution            eps_T in [0, 1]; default 0
//            rotorub_width                             m, > 0, of the ring along its axis; default:
//                                                      its geom's (cylinder, capsule, box), else
//                                                      endless
// Every other name that begins with rotorub_ is refused. Lengths, mu and eps are those of the scene
// file's [contact]. The ring's axis is the z axis of its geom; the rotor is where its geom's centre is.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

bool has_own_contact(const mjModel* m);  // a name in <custom> begins with rotorub_

// Of a model with a scene's text. Throws ConfigError.
void refuse_own_beside_scene(const mjModel* m);

// Fills contact, model.contact, geoms and pair. Throws ConfigError.
void map_own_contact(const mjModel* m, Config& config);

}  // namespace rotorub::plugin
