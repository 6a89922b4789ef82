// Is the rotor, or the ring, still where something holds it? Beyond it the model no longer
// describes the machine, and a run ends with Status::kOutOfRange.
#pragma once

#include <optional>
#include <string>

#include "native_model/model/model.h"

namespace rotorub {

// Why the configuration q (nq values) is out of range; empty where it is not:
//   the ring is displaced along an axis of its actuator by the magnets' air gap or more,
//   the rotor is deeper in a ring than `depth` (m): absent, than the ring's clearance,
//   a rotor without a ring is further away than any machine is large: nothing holds it.
// A few operations, and no allocation where the answer is empty: to be asked at every step.
std::optional<std::string> out_of_range(const Model& model, const double* q,
                                        std::optional<double> depth = {});

}  // namespace rotorub
