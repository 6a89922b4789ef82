// What stands in the files that the commands write, for readers: names, units, meanings, signs. Written beside the
// data as columns.json, and as tables in compare/study/README.md, which a test holds to this.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Keys of summary.json; "above_modes.contact_share": within another.
std::span<const ColumnMeaning> summary_keys();
// Keys of a run's `metrics` in compare.json, SI: the figures, and what stands beside them.
std::span<const ColumnMeaning> metric_keys();

// {"<file>": [{"name", "unit", "meaning"}, ...], ...} in the order of the columns. Of a run: its own columns, each by
// its name and with its unit.
nlohmann::ordered_json run_columns_json(const Trajectory& trajectory);
nlohmann::ordered_json compare_columns_json();

// Markdown: a section a file, with its table.
std::string columns_markdown();
inline constexpr const char* kColumnsBegin = "<!-- columns: begin (from the program) -->\n";
inline constexpr const char* kColumnsEnd = "<!-- columns: end -->\n";

}  // namespace rotorub
