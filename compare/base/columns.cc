#include "compare/base/columns.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace rotorub {
namespace {
using nlohmann::ordered_json;
}

ordered_json column_json(std::string_view name, std::string_view unit, std::string_view meaning) {
  return {{"name", name}, {"unit", unit}, {"meaning", meaning}};
}

ordered_json columns_json(std::span<const ColumnMeaning> columns) {
  ordered_json all = ordered_json::array();
  for (const ColumnMeaning& c : columns) all.push_back(column_json(c.name, c.unit, c.meaning));
  return all;
}

std::string columns_text(const ordered_json& columns) {
  // One line per column.
  std::string text = "{";
  for (auto file = columns.begin(); file != columns.end(); ++file) {
    text += fmt::format("{}\n  {}: [", file == columns.begin() ? "" : ",",
                        ordered_json(file.key()).dump());
    for (std::size_t k = 0; k < file->size(); ++k) {
      text += (k == 0 ? "\n    " : ",\n    ") +
              (*file)[k].dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    }
    text += "\n  ]";
  }
  return text + "\n}\n";
}

}  // namespace rotorub
