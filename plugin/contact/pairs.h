// The contacts of a model, its own or a generated one, each by its contact model:
//   rigid    verlet.h on the modal chain; elsewhere rigid.h, with MuJoCo's mass matrix
//   coulomb  coulomb.h's: normal force and friction as one problem in accelerations, MuJoCo's
//            reference set such that its solver finds the normal force
//   cone     MuJoCo's own, in the exact circle
//   cone-coulomb  the same, corrected for sliding (contact/cone.h)
// Contacts that act on the same bodies are solved together (rigid_solver.h), and with them the
// constraints that act on those bodies (constraint_probe.h).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

// Called in mjcb_control, when the velocity stage is fresh. Adds to d->qfrc_passive.
void apply_contacts(const Config& config, const mjModel* m, mjData* d);

// Disc in ring, exactly: MuJoCo's collision function of the pair. Fills con[0] where the gap is
// below the pair's margin, and returns the number of contacts (0, 1). dist is the gap g_N
// (negative: penetration), the frame (e_r, e_t, e_z) seen from the rotor's geom (turned where it is
// the second), the position the rotor's surface point, so that the lever arm of friction about the
// rotor's axis is its radius. con: at least one, uninitialised; g1: the first geom.
int collide_exactly(const ContactPair& pair, const mjData* d, CollisionContact* con, int g1,
                    double margin);

}  // namespace rotorub::plugin
