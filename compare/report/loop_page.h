// The plots of the closed loop of magnetic bearings on the page of `rotorub modes`: page/loop.js.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/modes/rotor_analysis.h"

namespace rotorub {

// For every speed with such a loop: {"title", "sensitivity": [{"name", "f": Hz, "y": dB, "peak":
// [Hz, dB]}], "step": [{"name", "t": ms, "y": um/N, "peak": [t, y] or null, "settled": [t, y],
// "steady"}]}.
nlohmann::json loop_plots(const RotorAnalysis& analysis);

}  // namespace rotorub
