// Which scenes the closed forms of native_model/oracles describe, and what they say.
#pragma once

#include <string>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::bench {

// The closed form of the scene, if it has one: replaces positions and normal force, row by row.
// Gives its name; empty where there is none.
std::string put_closed_form(const scene::Scene& scene, Trajectory& trajectory);

}  // namespace rotorub::bench
