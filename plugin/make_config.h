// Makes the Config of an mjModel from its custom text and its elements.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// True if the model has a scene or contacts of the user's own geoms, in <custom> or in instances of
// the engine plugin.
bool is_ours(const mjModel* m);

// Throws ConfigError.
Config make_config(const mjModel* m);
// The same Config with m's present numbers. m must have its fingerprint. Throws ConfigError.
Config with_parameters(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
