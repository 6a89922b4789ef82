// Rotor and ring as a linear plant for the design of a law (control/quadratic.h), including the
// states of the magnetic bearings' feedbacks.
#pragma once

#include <cstddef>
#include <string>

#include "native_model/control/quadratic.h"
#include "native_model/model/model.h"

namespace rotorub {

// The plant of an auxiliary bearing with a ring and a contact, at the constant spin speed `speed`
// (rad/s). Spin, torsion, the angle of the ring and the coils are left out. Magnetic bearings that
// work at t = 0 enter with their linear laws.
LinearPlant plant_of(const Model& model, std::size_t bearing, double speed);

// The reason why plant_of() does not represent the scene for an auxiliary bearing; empty if it
// does. every: s, sample time of the law to be designed; 0: continuous-time matrices are requested.
std::string beyond_linear_plant(const scene::Scene& scene, std::size_t bearing, const Model& model,
                                double every = 0.0);

}  // namespace rotorub
