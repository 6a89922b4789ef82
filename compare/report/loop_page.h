// The closed loop of magnetic bearings on the page of `rotorub modes`: the cells of
// modes/levitation_text.h as tables, and what page/loop.js draws.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/modes/rotor_analysis.h"

namespace rotorub {

// Of every speed with such a loop: {"index", "title", "refused": why it has no poles, or "",
// "has_curves", "has_steps", "loop_sheets": [{"caption", "columns", "rows": [{"cells"}],
// "notes"}]}.
nlohmann::json loop_values(const RotorAnalysis& analysis);

// Of the same: {"sensitivity": [{"name", "f": Hz, "y": dB, "peak": [Hz, dB]}], "step": [{"name",
// "t": ms, "y": um/N, "peak": [t, y] or null, "settled": [t, y], "steady"}]}.
nlohmann::json loop_plots(const RotorAnalysis& analysis);

}  // namespace rotorub
