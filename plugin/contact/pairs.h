// The contacts of a user's own or a generated model, each by its contact model:
//   rigid         verlet.h on the modal chain; elsewhere rigid.h, with MuJoCo's mass matrix
//   coulomb       coulomb.h: normal force and friction as one problem in accelerations; MuJoCo's
//                 reference is set so that its solver finds the normal force
//   cone          MuJoCo's own contact, in the exact circle
//   cone-coulomb  the same, corrected for sliding (contact/cone.h)
// A compliant contact (native_model/contact/compliance.h) is a pair of `coulomb` or of a cone whose
// normal force is given.
// Contacts that act on the same bodies are solved together (rigid.h), also with the
// constraints that act on those bodies (constraint_probe.h).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/contact/relative_motion.h"
#include "plugin/model/config.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

// Called by apply_command_and_contacts() (passes.cc), when the results of the velocity stage are up
// to date. Adds to d->qfrc_passive.
void apply_contacts(const Config& config, const mjModel* m, mjData* d, PassMotion& motion);

// MuJoCo's collision function of the pair: a disc in an exact ring. Fills con[0] if the gap is
// below the pair's margin, and returns the number of contacts (0, 1). dist is the gap g_N
// (negative: penetration). The frame is (e_r, e_t, e_z) if the rotor's geom is the first; otherwise
// e_r and e_t are reversed. The position is the rotor's surface point, so that the lever arm of
// friction about the rotor's axis is its radius. con: at least one, uninitialised; g1: the first
// geom.
int collide_exactly(const ContactPair& pair, const mjData* d, CollisionContact* con, int g1,
                    double margin);

}  // namespace rotorub::plugin
