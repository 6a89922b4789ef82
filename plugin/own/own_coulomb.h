// Contact model `coulomb` (contact/coulomb.h) in MuJoCo's coordinates: the contacts of one pass.
#pragma once

#include <mujoco/mujoco.h>

#include <span>

#include "plugin/config.h"

namespace rotorub::plugin {

// Of the pairs that are coulomb: their friction is added to d->qfrc_passive, and the references of their
// rows are set. Of those that are cone, the memory. In mjcb_control.
void apply_own_coulomb(std::span<const OwnPair> pairs, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
