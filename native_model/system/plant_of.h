// The linear plant (control/linear_plant.h) of a model.
#pragma once

#include "native_model/control/linear_plant.h"
#include "native_model/system/model.h"

namespace rotorub {

// At the spin speed `speed` (rad/s), held; spin, torsion, an angle of the ring and coils are left
// out. Asserts a ring and a contact.
LinearPlant plant_of(const Model& model, std::size_t bearing, double speed);

}  // namespace rotorub
