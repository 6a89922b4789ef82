// A comparison as JSON, a number that is not finite as null, and what stands in it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// What stands in the files that the commands write, for readers: names, units, meanings, signs.
// Written beside the data as columns.json, and as tables in compare/study/README.md, which a test
// holds to this.
nlohmann::ordered_json compare_columns_json();

// Markdown: a section a file, with its table.
std::string columns_markdown();
inline constexpr const char* kColumnsBegin = "<!-- columns: begin (from the program) -->\n";
inline constexpr const char* kColumnsEnd = "<!-- columns: end -->\n";

// One scene of compare.json, and the whole.
nlohmann::json comparison_json(const SceneComparison& comparison);
nlohmann::json comparisons_json(const std::vector<SceneComparison>& comparisons);

}  // namespace rotorub
