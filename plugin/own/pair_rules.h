// What the <pair> of a user's own model must say, so that MuJoCo's solver does the contact law's
// share and no more.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "plugin/config.h"
#include "plugin/own/own_names.h"

namespace rotorub::plugin {

// "<contact><pair geom1=... geom2=...>"
std::string pair_element(const mjModel* m, const ContactPair& pair);

// Throws ConfigError.
void check_pair(const mjModel* m, const PairName& name, const ContactPair& pair);

}  // namespace rotorub::plugin
