// Contact model `rigid` in MuJoCo's coordinates: the contacts of one pass.
#pragma once

#include <mujoco/mujoco.h>

#include <span>

#include "plugin/config.h"

namespace rotorub::plugin {

// Those of the pairs that are rigid. In mjcb_control; adds to d->qfrc_passive.
void apply_rigid(std::span<const ContactPair> pairs, const mjModel* m, mjData* d);

}  // namespace rotorub::plugin
