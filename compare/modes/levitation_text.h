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

// For a levitation that has a loop. {"poles": [{"real", "imaginary"}] in 1/s, by falling real part,
// or null, "poles_refused": the reason, or null, "sample_time": s, 0: continuous, "loops":
// [{"bearing": from 1, "axis": "x" or "y", "sensitivity": the peak of |S|, "frequency": rad/s,
// "zone": of ISO 14839-3, "step": {"largest": m/N, "largest_at": s or null, "steady": m/N,
// "static_stiffness": N/m or null, "rise_time": s or null, "overshoot": a share or null,
// "settling_time": s} as in StepResponse, "unbalance": m, peak to peak}]}. All but "bearing" and
// "axis" are null for an unstable loop. speed: rad/s.
result::Section levitation_section(double speed, const Levitation& levitation);

// A sentence if the closed loop is unstable or its stability is unknown, else empty. speed: rad/s.
std::string instability_text(double speed, const Levitation& levitation);

// speed: rad/s.
std::string levitation_title(double speed, const Levitation& levitation);

}  // namespace rotorub
