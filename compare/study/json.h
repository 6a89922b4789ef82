// A comparison as JSON and the meaning of its keys. A number that is not finite becomes null.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// Names, units and meanings of the keys; written as columns.json in the same folder.
nlohmann::ordered_json compare_columns_json();

// One scene of compare.json, and the whole file.
nlohmann::json comparison_json(const SceneComparison& comparison);
nlohmann::json comparisons_json(const std::vector<SceneComparison>& comparisons);

}  // namespace rotorub
