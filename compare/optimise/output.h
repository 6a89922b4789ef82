// The result of an optimisation as JSON, tables and text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "compare/optimise/optimiser.h"

namespace rotorub::optimise {

// {"figure", "goal" (minimise, maximise), "ending", "evaluations", "best": {"evaluation", "values":
// {key: SI}, "edge" (edge_text(), or null), "figure", "constraints": [{"figure", "min" or "max",
// "value"}]}, or null if no evaluation meets the constraints}.
nlohmann::ordered_json optimum_json(const Task& task, const Optimum& optimum);

// evaluations.csv: a header line, then one line per evaluation in their order, SI; and its columns
// in the format of columns.json.
std::string evaluations_csv(const Task& task, const Optimum& optimum);
nlohmann::ordered_json evaluations_columns_json(const Task& task);

// For people; ends with a line break.
std::string optimum_text(const std::string& name, const Task& task, const Optimum& optimum);

// If the best is at an end of a range: "at the upper end of the range of stator.damping: a wider
// range may hold better values"; otherwise empty.
std::string edge_text(const Task& task, const Optimum& optimum);

// "least_gap >= 0.0001"
std::string constraint_text(const Constraint& constraint);

}  // namespace rotorub::optimise
