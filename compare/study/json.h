// A comparison as JSON. A number that is not finite becomes null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// One scene of compare.json, and the whole.
nlohmann::json comparison_json(const SceneComparison& comparison);
nlohmann::json comparisons_json(const std::vector<SceneComparison>& comparisons);

}  // namespace rotorub
