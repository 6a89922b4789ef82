// Finds the Config of a model in the callbacks, from any thread, without a lock once it is known.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Null for a model that the plugin has nothing to do with. Compares the model's address and the
// mark that `d` carries: if a new model has the address of an old one, its new mjData has no mark
// yet. Valid until this thread asks again. Raises mju_error for text or elements that do not fit.
const Config* find_config(const mjModel* m, const mjData* d);

// The same, but also compares the model's whole text, names and numbers. Called once in a step, so
// that a model that was changed in place is noticed.
const Config* find_config_checked(const mjModel* m, const mjData* d);

}  // namespace rotorub::plugin
