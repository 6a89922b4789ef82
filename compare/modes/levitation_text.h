// Magnetic bearings in `rotorub modes`: closed loop, sensitivities and responses to a force step
// and to the unbalance, as text and as JSON. The page shows the same cells (report/loop_page.h).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "native_model/linear/levitation.h"

namespace rotorub {

// null without a controlled magnetic bearing; otherwise {"poles": [{"real", "imaginary"}] in 1/s,
// by falling real part, or null, "poles_refused": the reason, or null, "sample_time": s, 0:
// continuous, "loops": [{"bearing": from 1, "axis": "x" or "y", "sensitivity": the peak of |S|,
// "frequency": rad/s, "zone": of ISO 14839-3, "step": {"largest": m/N, "largest_at": s or null,
// "steady": m/N, "static_stiffness": N/m or null, "rise_time": s or null, "overshoot": a share or
// null, "settling_time": s} as in StepResponse, "unbalance": m, peak to peak}]}. "step" and
// "unbalance" are null for an unstable loop.
nlohmann::json levitation_json(const Levitation& levitation);

// A table of texts for people.
struct LoopSheet {
  struct Column {
    std::string head;
    int width;  // of the text; < 0: left-aligned
  };
  std::string caption;  // may be empty
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;
};
std::vector<LoopSheet> levitation_sheets(const Levitation& levitation);

// speed: rad/s.
std::string levitation_title(double speed, const Levitation& levitation);
// The title and the sheets as text. Empty without a controlled magnetic bearing.
std::string levitation_table(double speed, const Levitation& levitation);

}  // namespace rotorub
