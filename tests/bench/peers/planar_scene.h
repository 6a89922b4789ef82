// Converts a scene to the planar system that peers receive.
#pragma once

#include "native_model/scene/scene.h"
#include "tests/bench/peers/planar_system.h"

namespace rotorub::peers {

// Throws std::runtime_error with the name of a part that a planar system of one mode cannot
// represent.
PlanarSystem planar_system(const scene::Scene& scene);

}  // namespace rotorub::peers
