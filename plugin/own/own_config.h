// A user's own MJCF, without a scene of ours: contacts of a rotor's geom in a ring's geom. Given in
// <custom>, of each contact (own_names.h says how several are named):
//   text     rotorub_rotor_geom, rotorub_ring_geom     names of the two geoms
//            rotorub_contact                           rigid (default) | coulomb | cone
//   numeric  rotorub_clearance                         m, > 0
//            rotorub_radius                            m, > 0; default: the rotor geom's size[0]
//            rotorub_friction, rotorub_restitution     mu >= 0; eps_N in [0, 1]; default 0
//            rotorub_tangential_restitution            eps_T in [0, 1]; default 0
//            rotorub_width                             m, > 0, of the ring along its axis; default:
//                                                      its geom's (cylinder, capsule, box), else
//                                                      endless
// and once in the model
//   numeric  rotorub_userdata                          index in mjData.userdata of the first of our
//                                                      entries; default 0
// Every other name with rotorub_ in it is refused. Lengths, mu and eps are those of the scene
// file's [contact]. The ring's axis is the z axis of its geom; the rotor is where its geom's centre
// is.
#pragma once

#include <mujoco/mujoco.h>

#include <array>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Fills own, pairs, memory and memory_size, and the contact of the config with the first pair.
// Throws ConfigError.
void map_own_contacts(const mjModel* m, Config& config);

// ContactPair::read of now: what a contact takes from them, or was held against, changes with
// them.
std::array<mjtNum, 8> own_numbers(const mjModel* m, const ContactPair& pair);
// Whether rotors and rings of m, of the config's fingerprint, move along their axes as in the
// config.
bool same_motion(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
