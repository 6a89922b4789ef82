#include "compare/report/sweep_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/units.h"
#include "compare/report/linear_maps.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/result/result.h"
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

// Index of each key's value in its list, for point `index` of a grid.
std::vector<std::int64_t> places(const sweep::Study& study, std::int64_t index) {
  std::vector<std::int64_t> all(study.vary.size());
  for (std::size_t k = study.vary.size(); k-- > 0;) {
    all[k] = index % study.vary[k].count;
    index /= study.vary[k].count;
  }
  return all;
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

// The first points that failed.
Section failures(sweep::Store& store, const sweep::Study& study) {
  constexpr std::size_t kListed = 50;
  const int status = static_cast<int>(study.vary.size()) + 1;
  result::Table table{.columns = {{.heading = "point", .width = -8}}};
  for (const Vary& vary : study.vary)
    table.columns.push_back({.heading = name_and_unit(vary.key, vary.unit), .width = -28});
  table.columns.push_back({.heading = "status", .width = -20});
  table.columns.push_back({.heading = "reason"});
  store.each([&](const Statement& row) {
    if (table.rows.size() >= kListed || row.text(status) == "ok") return;
    std::vector<Item>& items = table.rows.emplace_back().items;
    items.push_back({.text = std::to_string(row.whole(0))});
    for (int k = 1; k < status; ++k) {
      items.push_back(
          {.text = row.is_text(k) ? row.text(k) : fmt::format("{:.6g}", row.number(k))});
    }
    items.push_back({.text = row.text(status)});
    items.push_back({.text = row.text(status + 1)});
  });
  const bool any = !table.rows.empty();
  return {.parts = {result::line("Points that failed", Role::kHeading), std::move(table),
                    Sentence{.text = any ? "At most fifty are listed; results.csv has all of them."
                                         : "none"}}};
}

json cards_of(sweep::Store& store) {
  const auto counts = store.count_by_status();
  const std::int64_t all = store.count();
  const auto ok = counts.contains("ok") ? counts.at("ok") : 0;
  std::vector<std::string> others, kinds;
  for (const auto& [status, count] : counts)
    if (status != "ok") others.push_back(fmt::format("{} {}", count, status));
  std::map<std::string, std::int64_t> attractors;
  std::optional<double> peak;
  std::int64_t peak_point = 0;
  const auto names = store.names();
  const auto at = [&](const char* name) {
    return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const int impulse = at("peak_impulse"), attractor = at("attractor");
  store.each([&](const Statement& row) {
    if (!row.is_nothing(attractor)) ++attractors[row.text(attractor)];
    if (row.is_nothing(impulse) || (peak && *peak >= row.number(impulse))) return;
    peak = row.number(impulse);
    peak_point = row.whole(0);
  });
  for (const auto& [name, count] : attractors) kinds.push_back(fmt::format("{} {}", count, name));
  const auto joined = [](const auto& words) { return fmt::format("{}", fmt::join(words, ", ")); };
  return {
      card("Points", ok == all ? "good" : "bad", fmt::format("{} of {} ran to their end", ok, all),
           others.empty() ? "none failed" : joined(others)),
      card("Attractors", "",
           attractors.size() == 1 ? "the same everywhere"
                                  : fmt::format("{} kinds", attractors.size()),
           joined(kinds)),
      card("Largest impact", "", peak ? fmt::format("{:.4g} N s", *peak) : "none",
           peak ? fmt::format("point {}", peak_point) : "")};
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
  json values(keys, json::array()), figures(columns.size(), json::array()), status = json::array();
  std::vector<std::string> statuses{"ok"};
  store.each([&](const Statement& row) {
    const std::int64_t point = row.whole(0);
    if (point % every != 0) return;
    const auto place = grid ? places(study, point) : std::vector<std::int64_t>();
    for (std::size_t k = 0; k < keys; ++k) {
      const int column = static_cast<int>(k) + 1;
      values[k].push_back(grid ? json(place[k])
                               : field(row, column, shown_unit(study.vary[k].unit).per_si));
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
  return {{"kind", grid ? "grid" : "marks"},
          {"keys", keys_of(study, grid)},
          {"figures", figures_json()},
          {"values", values},
          {"columns", figures},
          {"status", status},
          {"statuses", statuses},
          {"every", every}};
}

json sweep_json(const sweep::PointScenes& scenes, sweep::Store& store, const sweep::Study& study) {
  json plots = sweep_plots(scenes, store, study);
  const sweep::LinearMap linear = sweep::linear_map(scenes);
  const bool has_linear =
      linear.any() && plots["kind"] == "grid" && plots["status"].size() == linear.points.size();
  if (has_linear) add_linear(linear, plots);
  return {{"name", study.scene.stem().string()},
          {"cards", cards_of(store)},
          {"maps", has_linear ? figure_choices(
                                    {"attractor", "peak_impulse", kLinearAttractors, kLinearGrowth})
                              : figure_choices({"attractor", "peak_impulse"})},
          {"linear", has_linear},
          {"linear_refused", linear.refused},
          {"plots", std::move(plots)}};
}

std::string sweep_page(const sweep::PointScenes& scenes, sweep::Store& store,
                       const sweep::Study& study, const json& kept, const PointRuns& runs,
                       const json& bifurcation) {
  json plots = kept.at("plots");
  plots["maps"] = kept.at("maps");
  plots["runs"] = runs_json(runs, scenes.sample().size());
  json parts = json::array();
  const auto note = [&](const std::string& text) { parts.push_back({{"text", text}}); };
  parts.push_back({{"cards", kept.at("cards")}});
  if (const auto every = plots.at("every").get<std::int64_t>(); every > 1)
    note(fmt::format("Only every {}th point is drawn; results.csv has all of them.", every));
  if (!bifurcation.is_null())
    parts.push_back({{"class", "plots"}, {"parts", {{{"plots", "bifurcation"}}}}});
  parts.push_back({{"maps", 0}});
  note("Click a point, or enter its number, to see how to rerun it.");
  if (kept.at("linear")) {
    note(
        "Linear: which lasting rubs exist and are stable by their eigenvalues, without any run; "
        "the spin is held, and each load acts for ever.");
  }
  const std::string refused = kept.at("linear_refused");
  if (!refused.empty()) note("Linear map: " + refused + ".");
  Section found;
  if (study.statistics) found.add({statistics_of(store, study)});
  found.add({failures(store, study)});
  json sheets = page_json(found);
  sheets.push_back({{"figures", 0}});
  sheets.push_back({{"summary", "The study"}, {"pre", study.text}});
  sheets.push_back({{"summary", "The scene"}, {"pre", scenes.scene_text()}});
  parts.push_back({{"class", "sheets"}, {"parts", sheets}});
  json data{{"maps", {plots}}};
  if (!bifurcation.is_null()) data["bifurcation"] = bifurcation;
  return laid_out_page({kept.at("name"), "sweep", "What does it do, and where?"}, found, parts,
                       std::move(data), "The results are in results.csv, in SI units.");
}

}  // namespace rotorub
