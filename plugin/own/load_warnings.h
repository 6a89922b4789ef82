// Warnings about a model that the plugin accepts, although it hardly does what its author expects.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// One sentence for each user sensor whose name is nearly the name of a sensor that the plugin
// fills, so that it stays 0, and one for contacts with friction in two directions that MuJoCo's
// solver computes with a pyramid. The result is null if there is no warning.
std::shared_ptr<LoadWarnings> load_warnings(const mjModel* m, const Config& config);

// Issues them once, in the first step of a run beyond time 0: MuJoCo also takes a step at time 0
// while it compiles a model, and would count a warning there as an error of the file.
void tell_load_warnings(const Config& config, const mjData* d);

}  // namespace rotorub::plugin
