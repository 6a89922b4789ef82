// Whether rotor and ring are where something holds them.
#pragma once

#include <string>

#include "native_model/system/model.h"

namespace rotorub {

// Empty, or why the state is out of range: the rotor further outside the ring than the clearance
// (penetration, m), the ring beyond the air gap of its magnets.
std::string out_of_range(const Model& model, const double* q, double penetration);

}  // namespace rotorub
