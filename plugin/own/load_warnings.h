// Warnings about a model that the plugin accepts, although it hardly does what its author expects.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// One sentence for each
// - user sensor whose name is nearly the name of a sensor that the plugin fills, so that it stays
// 0;
// - contact with friction in two directions that MuJoCo's solver computes with a pyramid.
std::vector<std::string> load_warnings(const mjModel* m, const Config& config);

}  // namespace rotorub::plugin
