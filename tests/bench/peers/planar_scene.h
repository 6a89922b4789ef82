// From a scene to the planar system that peers are given.
#pragma once

#include "native_model/scene/scene.h"
#include "tests/bench/peers/planar_system.h"

namespace rotorub::peers {

// Throws std::runtime_error that names the part for a scene with one that a planar system of one
// mode has no place for.
PlanarSystem planar_system(const scene::Scene& scene);

}  // namespace rotorub::peers
