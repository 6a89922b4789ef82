// The closed loop of magnetic bearings on the page of `rotorub modes`: the cells of
// modes/levitation_text.h as tables, and the data of page/loop.js.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/modes/rotor_analysis.h"

namespace rotorub {

// For every speed with such a loop: {"index", "title", "refused": why it has no poles, or "",
// "has_curves", "has_steps", "loop_sheets": [{"caption", "columns", "rows": [{"cells"}],
// "notes"}]}.
nlohmann::json loop_values(const RotorAnalysis& analysis);

// For the same speeds: {"sensitivity": [{"name", "f": Hz, "y": dB, "peak": [Hz, dB]}], "step":
// [{"name", "t": ms, "y": um/N, "peak": [t, y] or null, "settled": [t, y], "steady"}]}.
nlohmann::json loop_plots(const RotorAnalysis& analysis);

}  // namespace rotorub
