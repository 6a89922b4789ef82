// Magnetic bearings in `rotorub modes`: closed loop and sensitivities, as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "native_model/system/levitation.h"

namespace rotorub {

// null without a magnetic bearing that controls; else {"poles": [{"real", "imaginary"}] in 1/s, by
// falling real part, or null, "poles_refused": why, or null, "sample_time": s, 0: continuous,
// "loops":
// [{"bearing": from 1, "axis": "x" or "y", "sensitivity": the peak of |S|, "frequency": rad/s,
// "zone": of ISO 14839-3}]}.
nlohmann::json levitation_json(const Levitation& levitation);

// speed: rad/s. Empty without one.
std::string levitation_table(double speed, const Levitation& levitation);

}  // namespace rotorub
