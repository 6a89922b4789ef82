#include "compare/study/column_files.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/columns.h"
#include "compare/figures/json.h"
#include "compare/measured/json.h"
#include "compare/run_files/summary.h"

namespace rotorub {
namespace {

using nlohmann::ordered_json;

std::string section(std::string_view file, std::span<const ColumnMeaning> columns) {
  return fmt::format("### `{}`\n\n{}\n", file, columns_table(columns));
}

}  // namespace

ordered_json compare_columns_json() {
  return {{"compare.json runs.*.metrics", columns_json(metric_keys())},
          {"compare.json runs.*.summary", columns_json(summary_keys())},
          {"compare.json measured", columns_json(measured_keys())}};
}

std::string columns_markdown() {
  return section("series.csv", series_columns()) + section("impacts.csv", impact_columns()) +
         section("events.csv", event_columns()) + section("summary.json", summary_keys()) +
         section("compare.json: metrics of a run", metric_keys()) +
         section("compare.json: a measured run", measured_keys());
}

}  // namespace rotorub
