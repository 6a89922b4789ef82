// A comparison as JSON, a number that is not finite as null, and what stands in it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// What stands in it, for readers: names, units, meanings. Written beside it as columns.json.
nlohmann::ordered_json compare_columns_json();

// One scene of compare.json, and the whole.
nlohmann::json comparison_json(const SceneComparison& comparison);
nlohmann::json comparisons_json(const std::vector<SceneComparison>& comparisons);

}  // namespace rotorub
