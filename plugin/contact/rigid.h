// Contact model `rigid` in MuJoCo's coordinates: the contacts of one pass.
#pragma once

#include <mujoco/mujoco.h>

#include <span>

#include "native_model/contact/rigid_law.h"
#include "plugin/config.h"
#include "plugin/contact/contact_space.h"

namespace rotorub::plugin {

// Those of the pairs that are rigid. In mjcb_control; adds to d->qfrc_passive.
void apply_rigid(std::span<const ContactPair> pairs, const mjModel* m, mjData* d);

// `rigid` over one step of MuJoCo, in any contact space: segments and models of the user's own.

// Adds the step's impulses to d->qfrc_passive, as forces over the step, and notes them (memory.h).
// `data`: index of the contact's memory (user_data.h). step: h, d and start; `start` may hold a
// spin that is no degree of freedom. After update_smooth_force. Where constraints of MuJoCo's
// solver act on the same bodies, contact and constraints are solved together (constraint_probe.h).
void apply_rigid_step(const mjModel* m, mjData* d, const ContactSpace& space, RigidStep& step,
                      const ContactParameters& contact, int data = 0);

}  // namespace rotorub::plugin
