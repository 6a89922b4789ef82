#include "compare/base/columns.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace rotorub {
namespace {
using nlohmann::ordered_json;
}

std::vector<std::string> column_names(std::span<const ColumnMeaning> columns) {
  std::vector<std::string> names;
  for (const ColumnMeaning& c : columns) names.emplace_back(c.name);
  return names;
}

ordered_json columns_json(std::span<const ColumnMeaning> columns) {
  ordered_json all = ordered_json::array();
  for (const ColumnMeaning& c : columns) {
    all.push_back({{"name", c.name}, {"unit", c.unit}, {"meaning", c.meaning}});
  }
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
