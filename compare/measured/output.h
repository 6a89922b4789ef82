// A measured run in compare.json and on the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "compare/measured/measured_run.h"
#include "compare/result/result.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {

// The alignment as a sentence, the figures side by side, the difference in each column, and
// remarks; in JSON at "measured", SI.
result::Section measured_section(const MeasuredRun& run);

// Its key "alignment".
nlohmann::json alignment_json(const Alignment& alignment);

// Its keys, for columns.json and documents.
std::span<const ColumnMeaning> measured_keys();

// "≥ 12.3": with the sign of a bound.
std::string measured_value(const MeasuredFigure& figure);

}  // namespace rotorub
