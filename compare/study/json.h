// A run and a comparison as JSON. A number that is not finite becomes null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// summary.json of a run, as the contract names its keys.
nlohmann::json summary_json(const scene::Scene& scene, const Trajectory& trajectory);

// Figures (SI), settled state and residuals of a run.
nlohmann::json metrics_json(const Metrics& metrics);

// One scene of compare.json, and the whole.
nlohmann::json comparison_json(const SceneComparison& comparison);
nlohmann::json comparisons_json(const std::vector<SceneComparison>& comparisons);

}  // namespace rotorub
