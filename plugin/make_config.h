// Makes the Config of an mjModel, from its custom text and its elements.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Whether <custom> asks for anything of ours: a scene, or a contact of the user's own geoms.
bool is_ours(const mjModel* m);

// Throws ConfigError.
Config make_config(const mjModel* m);
// The same with m's numbers of now, m a model of its fingerprint. Throws ConfigError.
Config with_parameters(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
