// A measured run as text for the terminal.
#pragma once

#include <string>

#include "compare/measured/measured_run.h"

namespace rotorub {

// The alignment in a sentence, the figures side by side, what is left of each column, and remarks;
// at most 80 columns wide.
std::string measured_table(const MeasuredRun& run);

// What of a column is left against a run: "12.3" in "µm", and its share of the run's deviation:
// "4.1 %".
std::string residual_unit(const Measurable& what);
std::string residual_text(const Measurable& what, double value);
std::string share_text(const ColumnResidual& residual);
// "mean force, N"
std::string figure_label(const MeasuredFigure& figure);
// "≥ 12.3": a bound says so.
std::string measured_value(const MeasuredFigure& figure);

}  // namespace rotorub
