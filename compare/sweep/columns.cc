#include "compare/sweep/columns.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/columns.h"
#include "compare/sweep/point_result.h"

namespace rotorub::sweep {
namespace {

constexpr ColumnMeaning kPoint{"point", "", "number of the point in the study's order, from 0", ""};
constexpr std::string_view kVaried = "value of the varied key";
constexpr ColumnMeaning kOutcome[] = {
    {"status", "", "as of a run, or refused: its values make no scene that can run", ""},
    {"reason", "", "why it is not ok; its figures are then empty", ""},
};

}  // namespace

nlohmann::ordered_json sweep_columns_json(const Study& study) {
  auto all = nlohmann::ordered_json::array();
  const auto add = [&](const auto& c) { all.push_back(column_json(c.name, c.unit, c.meaning)); };
  add(kPoint);
  for (const Vary& vary : study.vary) all.push_back(column_json(vary.key, vary.unit, kVaried));
  for (const ColumnMeaning& column : kOutcome) add(column);
  for (const ResultColumn& column : result_columns()) add(column);
  return {{"results.csv", all}};
}

std::string sweep_columns_markdown() {
  std::vector<ColumnMeaning> all{kPoint, {"<key>", "SI", kVaried, "one for each key"}};
  all.insert(all.end(), std::begin(kOutcome), std::end(kOutcome));
  for (const ResultColumn& c : result_columns()) all.push_back({c.name, c.unit, c.meaning, ""});
  return columns_table(all);
}

}  // namespace rotorub::sweep
