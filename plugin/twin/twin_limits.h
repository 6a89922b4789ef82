// The effects that a twin leaves out of a machine, in words and with their sizes.
#pragma once

#include <string>
#include <vector>

#include "plugin/twin/linear_machine.h"
#include "plugin/twin/planes.h"

namespace rotorub::plugin {

// Sentences without a full stop. Empty if the twin leaves nothing out.
std::vector<std::string> twin_limits(const mjModel* m, const LinearMachine& machine,
                                     const TwinPlanes& planes);

}  // namespace rotorub::plugin
