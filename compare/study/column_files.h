// What stands in the files that the commands write, for readers: names, units, meanings, signs.
// Written beside the data as columns.json, and as tables in compare/study/README.md, which a test
// holds to this.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

nlohmann::ordered_json compare_columns_json();

// Markdown: a section a file, with its table.
std::string columns_markdown();
inline constexpr const char* kColumnsBegin = "<!-- columns: begin (from the program) -->\n";
inline constexpr const char* kColumnsEnd = "<!-- columns: end -->\n";

}  // namespace rotorub
