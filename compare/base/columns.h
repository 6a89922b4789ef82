// Descriptions of the columns in files that a command writes, as JSON for columns.json beside the
// data.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "native_model/trajectory/columns.h"

namespace rotorub {

inline constexpr const char* kColumnsFile = "columns.json";

// {"name", "unit", "meaning"}, and a list of these.
nlohmann::ordered_json column_json(std::string_view name, std::string_view unit,
                                   std::string_view meaning);
nlohmann::ordered_json columns_json(std::span<const ColumnMeaning> columns);

// {"<file>": [column, ...], ...} as text with one line per column, ending with a line break.
std::string columns_text(const nlohmann::ordered_json& columns);

}  // namespace rotorub
