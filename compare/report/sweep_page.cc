#include "compare/report/sweep_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/units.h"
#include "compare/report/linear_maps.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/result/result.h"
#include "compare/sweep/answer.h"
#include "compare/sweep/group_statistics.h"
#include "compare/sweep/linear_map.h"

namespace rotorub {
namespace {

using nlohmann::json;
using result::Item, result::Role, result::Section, result::Sentence;
using sweep::ResultColumn;
using sweep::SampleKind;
using sweep::Statement;
using sweep::Vary;

// The values of a key in a grid, in order.
json grid_values(const Vary& vary, double per_si) {
  if (!vary.values.empty()) {
    return list_of(vary.values, [&](const sweep::Value& value) {
      return value.number ? json(rounded(per_si * *value.number)) : json(value.text);
    });
  }
  const auto last = static_cast<double>(vary.count - 1);
  std::vector<double> values;
  for (std::int64_t i = 0; i < vary.count; ++i)
    values.push_back(sweep::between(vary, vary.count > 1 ? static_cast<double>(i) / last : 0.0));
  return rounded_list(values, per_si);
}

json field(const Statement& row, int column, double per_si) {
  if (row.is_nothing(column)) return nullptr;
  if (row.is_text(column)) return row.text(column);
  return rounded(per_si * row.number(column));
}

json keys_of(const sweep::Study& study, bool grid) {
  return list_of(study.vary, [&](const Vary& vary) {
    const ShownUnit unit = shown_unit(vary.unit);
    json key = {{"name", vary.key},
                {"unit", unit.name},
                {"even", vary.values.empty() && vary.spacing == sweep::Spacing::kLinear},
                {"log", vary.spacing == sweep::Spacing::kLog}};
    if (grid) key["values"] = grid_values(vary, unit.per_si);
    return key;
  });
}

json figures_json() {
  return list_of(sweep::result_columns(), [](const ResultColumn& column) -> json {
    return {{"name", column.name},
            {"unit", shown_unit(column.unit).name},
            {"meaning", column.meaning},
            {"word", column.value({}).is_string()}};
  });
}

// The points that failed, by their reason.
Section failures(sweep::Store& store, const sweep::Study& study) {
  constexpr std::size_t kListed = 50;
  const int status = static_cast<int>(study.vary.size()) + 1;
  struct Failure {
    std::int64_t points, first;
  };
  std::map<std::pair<std::string, std::string>, Failure> failed;
  store.each([&](const Statement& row) {
    if (row.text(status) == "ok") return;
    const std::pair key(row.text(status), row.text(status + 1));
    ++failed.try_emplace(key, Failure{0, row.whole(0)}).first->second.points;
  });
  if (failed.empty()) return {};
  result::Table table{.columns = {{.heading = "points", .width = 8},
                                  {.heading = "first", .width = 8},
                                  {.heading = "status", .width = -20},
                                  {.heading = "reason"}}};
  for (const auto& [why, failure] : failed) {
    if (table.rows.size() == kListed) break;
    table.rows.push_back({.items = {{.text = std::to_string(failure.points)},
                                    {.text = std::to_string(failure.first)},
                                    {.text = why.first},
                                    {.text = why.second}}});
  }
  return {.parts = {result::line("Points that failed", Role::kHeading), std::move(table),
                    result::line(failed.size() > kListed
                                     ? "The first fifty reasons; results.csv has all points."
                                     : "results.csv has all points.")}};
}

json runs_json(const PointRuns& runs, std::int64_t points) {
  json kept = json::object();
  for (const auto& [point, link] : runs.kept) kept[std::to_string(point)] = link;
  return {{"command", runs.command}, {"kept", kept}, {"points", points}};
}

// The rows of statistics.csv in the units of the page.
Section statistics_of(sweep::Store& store, const sweep::Study& study) {
  const sweep::Statistics& asked = *study.statistics;
  result::Table table;
  for (const std::size_t k : asked.by) {
    const Vary& vary = study.vary[k];
    table.columns.push_back({.heading = name_and_unit(vary.key, vary.unit), .width = -28});
  }
  for (const char* words : {"figure", "statistic"})
    table.columns.push_back({.heading = words, .width = -28});
  for (const char* number : {"value", "from", "to", "points"})
    table.columns.push_back({.heading = number, .width = 12});
  bool bounds = false;
  for (const sweep::StatisticsRow& row : sweep::group_statistics(store, study)) {
    const bool share = row.statistic.starts_with("share ");
    const ShownUnit unit = shown_unit(row.unit);
    const auto number = [&](std::optional<double> value) -> Item {
      if (!value) return {};
      return {.text = share ? fmt::format("{:.3g} %", 100.0 * *value)
                            : short_number(unit.per_si * *value)};
    };
    const sweep::Estimate& estimate = row.estimate;
    bounds = bounds || estimate.low || estimate.high;
    std::vector<Item>& items = table.rows.emplace_back().items;
    for (const std::string& value : row.group) items.push_back({.text = value});
    items.insert(items.end(), {{.text = name_and_unit(row.figure, unit.name)},
                               {.text = row.statistic},
                               number(estimate.value),
                               number(estimate.low),
                               number(estimate.high),
                               {.text = std::to_string(row.count)}});
  }
  const std::string note =
      bounds ? fmt::format(
                   "What is estimated lies between from and to with a confidence of {}, if "
                   "the points are independent.",
                   percent_text(asked.confidence))
             : "Bounds need independent points, as kind = \"random\" draws them.";
  return {.parts = {result::line("Statistics", Role::kHeading), std::move(table),
                    Sentence{.text = note + " The table is in statistics.csv."}}};
}

// Adds the figures of the linear map to the runs' figures. Row i of a whole grid's plots is point
// i.
void add_linear(const sweep::LinearMap& map, json& plots) {
  const json figures = rub_figures();
  std::vector<json> columns(figures.size(), json::array());
  for (const std::optional<rub::RubPoint>& point : map.points) {
    std::vector<json> row = point ? rub_values(*point) : std::vector<json>(figures.size());
    for (std::size_t k = 0; k < row.size(); ++k) columns[k].push_back(std::move(row[k]));
  }
  for (std::size_t k = 0; k < columns.size(); ++k) {
    plots["figures"].push_back(figures[k]);
    plots["columns"].push_back(std::move(columns[k]));
  }
}

}  // namespace

json sweep_plots(const sweep::PointScenes& scenes, sweep::Store& store, const sweep::Study& study) {
  const std::int64_t every = (scenes.sample().size() + kMostDrawn - 1) / kMostDrawn;
  const bool grid = study.kind == SampleKind::kGrid && every == 1;
  const auto columns = sweep::result_columns();
  const std::size_t keys = study.vary.size();
  json values(grid ? 0 : keys, json::array()), figures(columns.size(), json::array());
  json status = json::array();
  std::vector<std::string> statuses{"ok"};
  store.each([&](const Statement& row) {
    if (row.whole(0) % every != 0) return;
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k].push_back(
          field(row, static_cast<int>(k) + 1, shown_unit(study.vary[k].unit).per_si));
    }
    const std::string word = row.text(static_cast<int>(keys) + 1);
    const auto found = std::find(statuses.begin(), statuses.end(), word);
    status.push_back(found - statuses.begin());
    if (found == statuses.end()) statuses.push_back(word);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      figures[k].push_back(
          field(row, static_cast<int>(keys + 3 + k), shown_unit(columns[k].unit).per_si));
    }
  });
  json plots{{"kind", grid ? "grid" : "marks"},
             {"keys", keys_of(study, grid)},
             {"figures", figures_json()},
             {"columns", figures},
             {"status", status},
             {"statuses", statuses},
             {"every", every}};
  if (!grid) plots["values"] = values;
  return plots;
}

json sweep_json(const sweep::PointScenes& scenes, sweep::Store& store, const sweep::Study& study) {
  json plots = sweep_plots(scenes, store, study);
  const sweep::LinearMap linear = sweep::linear_map(scenes);
  if (linear.any() && plots["kind"] == "grid" && plots["status"].size() == linear.points.size())
    add_linear(linear, plots);
  return {{"name", study.scene.stem().string()},
          {"answer", sweep::answer_of(store, study)},
          {"linear_refused", linear.refused},
          {"plots", std::move(plots)}};
}

std::string sweep_page(const sweep::PointScenes& scenes, sweep::Store& store,
                       const sweep::Study& study, const json& kept, const PointRuns& runs,
                       const json& bifurcation) {
  Section found;
  for (const std::string sentence : kept.at("answer"))
    found.parts.emplace_back(Sentence{.text = sentence});
  if (study.statistics) found.add({statistics_of(store, study)});
  found.add({failures(store, study)});
  json plots = kept.at("plots");
  plots["runs"] = runs_json(runs, scenes.sample().size());
  json data{{"maps", {plots}},
            {"linear_refused", kept.at("linear_refused")},
            {"texts", {study.text, scenes.scene_text()}}};
  if (!bifurcation.is_null()) data["bifurcation"] = bifurcation;
  const std::string name = kept.at("name");
  std::vector<std::string> keys;
  for (const Vary& vary : study.vary) keys.push_back(vary.key);
  return laid_out_page(
      {name, "sweep", fmt::format("What does {} do over {}?", name, fmt::join(keys, " and "))},
      found, "sweep", std::move(data), "The results are in results.csv, in SI units.");
}

}  // namespace rotorub
