// Magnetic bearings in `rotorub modes`: closed loop, sensitivities and responses to a force step
// and to the unbalance, as text and as JSON.
#pragma once

#include <string>

#include "compare/result/result.h"
#include "native_model/linear/levitation.h"

namespace rotorub {

// Whether there is a controlled magnetic bearing.
bool has_loop(const Levitation& levitation);

// Whether the poles of its loop are known.
bool has_poles(const Levitation& levitation);

// For a levitation that has a loop (README.md lists the keys). speed: rad/s.
result::Section levitation_section(double speed, const Levitation& levitation);

// A sentence if the closed loop is unstable or its stability is unknown, else empty. speed: rad/s.
std::string instability_text(double speed, const Levitation& levitation);

}  // namespace rotorub
