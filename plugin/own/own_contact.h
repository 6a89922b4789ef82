// The contact models on a user's own model.
//   rigid    rigid_law.h, with MuJoCo's mass matrix
//   coulomb  coulomb.h's: normal force and friction as one problem in accelerations, MuJoCo's
//            reference set such that its solver finds the normal force
//   cone     MuJoCo's own, in the exact circle
//   cone-coulomb  the same, corrected for sliding (contact/cone_correction.h)
// Contacts that act on the same bodies are solved together (contact/coupled_law.h), and so are other
// constraints on them (contact/constraint_probe.h).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

// Called in mjcb_control, when the velocity stage is fresh. Adds to d->qfrc_passive.
void apply_own_contacts(const Config& config, const mjModel* m, mjData* d);

// As collide_annular, in the frame of the ring's geom.
int collide_own(const OwnPair& pair, const mjData* d, CollisionContact* con, int g1, double margin);

}  // namespace rotorub::plugin
