// The summary of a run: summary.json, its columns.json, and what `rotorub run` prints.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "compare/metrics/metrics.h"
#include "compare/result/result.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// With the keys of the contract. A number that is not finite becomes null.
nlohmann::json summary_json(const scene::Scene& scene, const Trajectory& trajectory);

// The part of it that the motion determines, as on the terminal: metrics_json with null for figures
// that a single run does not have (has_figure). Does not solve an eigenproblem of the rotor.
nlohmann::json run_numbers_json(const scene::Scene& scene, const Trajectory& trajectory);

// Whether and when rotor and ring touch in a run, how hard, and how the rub continues: the rest of
// a sentence that begins with "rubs: ". cut: the time at which the run ended early, s.
std::string rub_answer(const Metrics& metrics, std::optional<double> cut = {});

// For people that answer, then the figures, and notes on the modes that the scene leaves out; in
// JSON summary_json.
result::Section run_result(const scene::Scene& scene, const Trajectory& trajectory);

// For people the same answer and the figures of a kept run, from its summary_json.
result::Section kept_result(const nlohmann::json& summary);

// The keys of summary_json; "above_modes.contact_share" is within "above_modes".
std::span<const ColumnMeaning> summary_keys();

// {"<file>": [{"name", "unit", "meaning"}, ...], ...} in the order of the columns.
nlohmann::ordered_json run_columns_json(const Trajectory& trajectory);

}  // namespace rotorub
