// Contact model `rigid` in contact space (contact_space.h): the contacts of one forward pass, for
// segments, users' own models, and generated chains with a user's constraints. (Other generated
// chains have the native step, verlet.h.) Contacts that act on the same bodies are solved together,
// also with the constraints of MuJoCo's solver that act on them (constraint_probe.h).
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/contact/relative_motion.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// For the pairs with a rigid contact. Called by apply_command_and_contacts() (passes.cc); adds
// their impulses to d->qfrc_passive as forces over the step, and records them (contact_memory.h).
void apply_rigid(const Config& config, const mjModel* m, mjData* d, PassMotion& motion);

}  // namespace rotorub::plugin
