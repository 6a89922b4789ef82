// The identified values on the terminal and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "compare/identify/identify.h"

namespace rotorub::identify {

// {"measured", "samples", "runs", "parameters": [{"key", "unit", "value", "error", "low", "high",
// "from", "to", "at_edge"}], "correlation", "alignment", "left_before", "left"}, SI.
nlohmann::json identify_json(const std::string& measured, const Result& result);

// At most 80 columns wide.
std::string identify_table(const std::string& measured, const Result& result);

}  // namespace rotorub::identify
