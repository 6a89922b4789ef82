// The result of an optimisation.
#pragma once

#include <string>
#include <vector>

#include "compare/optimise/optimiser.h"
#include "compare/result/result.h"
#include "native_model/trajectory/columns.h"

namespace rotorub::optimise {

// name: of the scene, for people. JSON: {"figure", "goal" (minimise, maximise), "ending",
// "evaluations", "best": {"evaluation", "answer": a sentence, "values": {key: SI}, "edge"
// (edge_text(), or null), "figure", "constraints": [{"figure", "min" or "max", "value"}]}, or null
// if no evaluation meets the constraints}.
result::Section result_of(const std::string& name, const Task& task, const Optimum& optimum);

// For the page: the goal of a search and its evaluations in their order, SI.
nlohmann::json search_json(const Task& task, const Optimum& optimum);

// evaluations.csv: a header line, then one line per evaluation in their order, SI; and its columns.
// The task must outlive them.
std::string evaluations_csv(const Task& task, const Optimum& optimum);
std::vector<ColumnMeaning> evaluations_columns(const Task& task);

// If the best is at an end of a range: "at the upper end of the range of stator.damping: a wider
// range may hold better values"; otherwise empty.
std::string edge_text(const Task& task, const Optimum& optimum);

// The SI unit of a figure; empty if dimensionless, and for figures of modes.
std::string unit_of(const FigurePath& figure);

}  // namespace rotorub::optimise
