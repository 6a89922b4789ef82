// A start on the steady free orbit, `[initial] steady`. The equations are in linear/steady_orbit.h.
#pragma once

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Adds the orbit at t = 0 to q0 and v0; the rest of the model must be complete. Throws
// scene::SceneError with key initial.steady if there is no such orbit (the free rotor is unstable,
// an undamped resonance is excited, nothing holds the rotor against a constant force, the magnets
// pull a ring away, or a ramp or pulse is under way), or if it touches a ring; the message then
// gives its size.
void add_orbit_start(const scene::Scene& scene, Model& model);

}  // namespace rotorub
