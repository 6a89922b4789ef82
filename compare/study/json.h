// Results as JSON. A number that is not finite becomes null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"
#include "native_model/rotor/contact_mass.h"

namespace rotorub {

// summary.json of a run, as the contract names its keys.
nlohmann::json summary_json(const scene::Scene& scene, const Trajectory& trajectory);

// {"kept", "mesh": kg, "kept_modes", "mesh_modes"}; null for none.
nlohmann::json contact_mass_json(const std::optional<ContactMass>& mass);

// Figures (SI), settled state and residuals of a run.
nlohmann::json metrics_json(const Metrics& metrics);

// One scene of compare.json, and the whole.
nlohmann::json comparison_json(const SceneComparison& comparison);
nlohmann::json comparisons_json(const std::vector<SceneComparison>& comparisons);

// As text on several lines, with its line break. Bytes that are no UTF-8, as of a file's name, are
// replaced: a result is not lost by its name.
std::string json_text(const nlohmann::json& value);

}  // namespace rotorub
