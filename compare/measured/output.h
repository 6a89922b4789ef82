// A measured run in compare.json and on the terminal.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "compare/measured/measured_run.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {

// {"file", "samples", "interval", "alignment", "columns", "figures", "remarks"}, SI.
nlohmann::json measured_json(const MeasuredRun& run);

// Of it "alignment".
nlohmann::json alignment_json(const Alignment& alignment);

// Its keys, for columns.json and documents.
std::span<const ColumnMeaning> measured_keys();

// The alignment in a sentence, the figures side by side, what is left of each column, and remarks;
// at most 80 columns wide.
std::string measured_table(const MeasuredRun& run);

// What of a column is left against a run: "12.3" in "µm", and its share of the run's deviation:
// "4.1 %".
std::string residual_unit(const Measurable& what);
std::string residual_text(const Measurable& what, double value);
std::string share_text(const ColumnResidual& residual);
// "≥ 12.3": a bound says so.
std::string measured_value(const MeasuredFigure& figure);

}  // namespace rotorub
