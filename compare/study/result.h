// A comparison as JSON and as text for the terminal, and the meaning of its keys.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/result/result.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// One scene: the answer, the figures side by side and their differences (in resync the differences
// at the onsets), the split of the judged figures, and for each contact model a verdict with its
// reasons. The text is at most 80 columns wide.
result::Section comparison_result(const SceneComparison& comparison);

// The whole of compare.json, for JSON alone. A number that is not finite becomes null.
result::Section comparisons_result(const std::vector<SceneComparison>& comparisons);

// Names, units and meanings of the keys; written as columns.json in the same folder.
nlohmann::ordered_json compare_columns_json();

}  // namespace rotorub
