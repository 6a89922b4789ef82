// summary.json of a run, and its columns.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// With the keys of the contract. A number that is not finite becomes null.
nlohmann::json summary_json(const scene::Scene& scene, const Trajectory& trajectory);

// The part of it that the motion determines, as on the terminal: metrics_json with null for figures
// that a single run does not have (has_figure). Does not solve an eigenproblem of the rotor.
nlohmann::json run_numbers_json(const scene::Scene& scene, const Trajectory& trajectory);

// The keys of summary_json; "above_modes.contact_share" is within "above_modes".
std::span<const ColumnMeaning> summary_keys();

// {"<file>": [{"name", "unit", "meaning"}, ...], ...} in the order of the columns.
nlohmann::ordered_json run_columns_json(const Trajectory& trajectory);

}  // namespace rotorub
