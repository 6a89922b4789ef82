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

// The difference of a column from a run: "12.3" in "µm", and relative to the run's deviation: "4.1
// %".
std::string residual_unit(const Measurable& what);
std::string residual_text(const Measurable& what, double value);
std::string share_text(const ColumnResidual& residual);
// "≥ 12.3": with the sign of a bound.
std::string measured_value(const MeasuredFigure& figure);

}  // namespace rotorub
