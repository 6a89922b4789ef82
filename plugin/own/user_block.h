// Our block in mjData.userdata of a user's own model, which others use too: it carries a check of
// what we wrote, so that entries that others write over are noticed.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

// As we left it, or as a reset leaves it (all 0). True for generated models: theirs is nobody
// else's.
bool block_is_ours(const Config& config, const mjData* d);

// After our own changes.
void seal_block(const Config& config, const mjData* d);

// mju_error that names the entries and how to move them.
void refuse_clash(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
