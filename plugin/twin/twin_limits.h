// What a twin leaves out of a machine, in words with its size.
#pragma once

#include <string>
#include <vector>

#include "plugin/twin/linear_machine.h"
#include "plugin/twin/planes.h"

namespace rotorub::plugin {

// Sentences without a full stop; none for what the twin has.
std::vector<std::string> twin_limits(const mjModel* m, const LinearMachine& machine,
                                     const TwinPlanes& planes);

}  // namespace rotorub::plugin
