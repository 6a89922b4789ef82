// What the columns of results.csv are: columns.json beside it, and the table in
// compare/sweep/README.md.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

// {"results.csv": [{"name", "unit", "meaning"}, ...]}, the study's own columns in their order.
nlohmann::ordered_json sweep_columns_json(const Study& study);

// Markdown: the table of all of them.
std::string sweep_columns_markdown();

}  // namespace rotorub::sweep
