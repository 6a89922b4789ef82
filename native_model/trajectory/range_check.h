// Is the rotor, or the ring, still where something holds it? Beyond, the model is none of the
// machine any more, and a run ends with Status::kOutOfRange.
#pragma once

#include <optional>
#include <string>

#include "native_model/system/model.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Why the configuration q (nq values) is out of range; empty where it is not:
//   the ring is displaced along an axis of its actuator by the magnets' air gap or more,
//   the rotor is deeper in the ring than `depth` (m): by default the clearance.
// A few operations, and no allocation where the answer is empty: to be asked at every step.
std::optional<std::string> out_of_range(const Model& model, const double* q);
std::optional<std::string> out_of_range(const Model& model, const double* q, double depth);

// Why the balance of the energy says that the run is none of the model's; empty where it does not:
// more energy came from nowhere, or went there, than the system ever held (residual above 1).
std::optional<std::string> out_of_balance(const Statistics& statistics);

}  // namespace rotorub
