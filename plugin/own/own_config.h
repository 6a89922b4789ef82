// A user's own MJCF without a scene: contacts of a rotor's geom in a ring's geom. They are
// described in <custom>, for each contact (own_names.h says how several are named):
//   text     rotorub_rotor_geom, rotorub_ring_geom     names of the two geoms
//            rotorub_contact                           rigid (default) | coulomb | cone |
//                                                      cone-coulomb
//   numeric  rotorub_clearance                         m, > 0
//            rotorub_radius                            m, > 0; default: the rotor geom's size[0]
//            rotorub_friction                          mu >= 0; default 0; or four numbers: static,
//                                                      kinetic, Stribeck speed (m/s), viscous (s/m)
//            rotorub_restitution                       eps_N in [0, 1]; default 0
//            rotorub_tangential_restitution            eps_T in [0, 1]; default 0
//            rotorub_friction_reference                1/s, B_t >= 0 of contact model cone;
//                                                      default: MuJoCo's own reference
//            rotorub_width                             m, > 0, length of the ring along its axis;
//                                                      default: from its geom (cylinder,
//                                                      capsule, box), else endless
// and once in the model
//   numeric  rotorub_userdata                          index of the plugin's first entry in
//                                                      mjData.userdata; default 0
// Also, text rotorub_cone_coulomb_pair names a <pair> that is corrected for sliding
// (contact/cone.h). Every other name that contains rotorub_ is refused. Lengths, mu and eps mean
// the same as in the scene file's [contact]. The ring's axis is the z axis of its geom; the rotor
// is at the centre of its geom.
#pragma once

#include <mujoco/mujoco.h>

#include <array>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Fills own, pairs, corrected_pairs, memory and memory_size, and the contact of the config from the
// first pair. Throws ConfigError.
void map_own_contacts(const mjModel* m, Config& config);

// The present values for ContactPair::read. If they change, so do the numbers that a contact takes
// from them or was checked against.
std::array<mjtNum, 10> own_numbers(const mjModel* m, const ContactPair& pair);
// True if the rotors and rings of m move along their axes as in the config. m must have the
// config's fingerprint.
bool same_motion(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
