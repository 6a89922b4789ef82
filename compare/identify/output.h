// The identified values as the result of a command.
#pragma once

#include <string>

#include "compare/identify/identify.h"
#include "compare/result/result.h"

namespace rotorub::identify {

// JSON: {"measured", "samples", "runs", "parameters": [{"key", "unit", "value", "error", "low",
// "high", "from", "to", "at_edge"}], "correlation", "alignment", "left_before", "left"}, SI.
result::Section result_of(const std::string& measured, const Result& found);

}  // namespace rotorub::identify
