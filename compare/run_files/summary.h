// summary.json of a run, and columns.json beside it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// As the contract names its keys. A number that is not finite becomes null.
nlohmann::json summary_json(const scene::Scene& scene, const Trajectory& trajectory);

// Of it what the motion shows, as the terminal has it: metrics_json with null for what a run by
// itself does not have (has_figure). No eigenproblem of the rotor.
nlohmann::json run_numbers_json(const scene::Scene& scene, const Trajectory& trajectory);

// Its keys; "above_modes.contact_share": within another.
std::span<const ColumnMeaning> summary_keys();

// {"<file>": [{"name", "unit", "meaning"}, ...], ...} in the order of the columns, each by its name
// and with its unit.
nlohmann::ordered_json run_columns_json(const Trajectory& trajectory);

}  // namespace rotorub
