// A start on the steady free orbit, `[initial] steady`. The orbit's equations:
// linear/steady_orbit.h.
#pragma once

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Adds the orbit at t = 0 to q0 and v0; all else of the model is as it will be. Throws
// scene::SceneError, key initial.steady, where there is none: the free rotor is unstable, resonance
// without damping, nothing that holds it against a constant force, a ring that its magnets pull
// away, a ramp or pulse under way; or where it touches, with its size.
void add_orbit_start(const scene::Scene& scene, Model& model);

}  // namespace rotorub
