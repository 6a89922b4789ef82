// Rotor and ring as a linear plant for the design of a law (control/quadratic.h), with all that the
// feedbacks of magnetic bearings remember.
#pragma once

#include <cstddef>
#include <string>

#include "native_model/control/quadratic.h"
#include "native_model/model/model.h"

namespace rotorub {

// About an auxiliary bearing with a ring and a contact, at the spin speed `speed` (rad/s), held;
// spin, torsion, an angle of the ring and coils are left out. Of magnetic bearings the linear laws
// of those that work at t = 0.
LinearPlant plant_of(const Model& model, std::size_t bearing, double speed);

// Why plant_of an auxiliary bearing is not the scene's; empty: it is. every: s, the sample time of
// the law that is designed; 0: the matrices are wanted as they are, in continuous time.
std::string beyond_linear_plant(const scene::Scene& scene, std::size_t bearing, const Model& model,
                                double every = 0.0);

}  // namespace rotorub
