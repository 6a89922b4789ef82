// What the plugin knows of the native model that runs alongside (shadow.h): its sensors and ghosts,
// and what tells one set of its numbers from another.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

// Fills the addresses of sensors and ghosts; `model` is the scene's. Throws ConfigError for a step
// that it cannot take.
void map_shadow(const mjModel* m, ShadowConfig& shadow);

// FNV-1a of the numbers that an edit of mjModel changes, as a whole number > 0 that a double holds.
double mark_of(const Model& model);

}  // namespace rotorub::plugin
