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
#include "compare/base/json.h"
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
using result::Section, result::Sentence;
using sweep::BranchPoint;
using sweep::ResultColumn;
using sweep::SampleKind;
using sweep::Statement;
using sweep::Vary;

// The values of a key in a grid, in order.
json grid_values(const Vary& vary, double per_si) {
  if (!vary.values.empty()) {
    return list_of(vary.values, [&](const sweep::Value& value) {
      return value.number ? json(per_si * *value.number) : json(value.text);
    });
  }
  const auto last = static_cast<double>(vary.count - 1);
  json values = json::array();
  for (std::int64_t i = 0; i < vary.count; ++i) {
    const double share = vary.count > 1 ? static_cast<double>(i) / last : 0.0;
    values.push_back(per_si * sweep::between(vary, share));
  }
  return values;
}

json field(const Statement& row, int column, double per_si) {
  if (row.is_nothing(column)) return nullptr;
  if (row.is_text(column)) return row.text(column);
  return per_si * row.number(column);
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

// The points that failed, by their reason: "first" is the number of the first one.
json failures_json(sweep::Store& store, const sweep::Study& study) {
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
  return list_of(failed, [](const auto& failure) -> json {
    const auto& [why, of] = failure;
    return {
        {"status", why.first}, {"reason", why.second}, {"points", of.points}, {"first", of.first}};
  });
}

json runs_json(const PointRuns& runs, std::int64_t points) {
  json kept = json::object();
  for (const auto& [point, link] : runs.kept) kept[std::to_string(point)] = link;
  return {{"command", runs.command}, {"kept", kept}, {"points", points}};
}

// The rows of statistics.csv, SI; null if the study asks for none.
json statistics_json(sweep::Store& store, const sweep::Study& study) {
  if (!study.statistics) return nullptr;
  const auto key = [&](std::size_t k) {
    return name_and_unit(study.vary[k].key, study.vary[k].unit);
  };
  const auto row = [](const sweep::StatisticsRow& r) -> json {
    return {{"group", r.group},
            {"figure", r.figure},
            {"unit", r.unit},
            {"statistic", r.statistic},
            {"estimate",
             {number_or_null(r.estimate.value), number_or_null(r.estimate.low),
              number_or_null(r.estimate.high)}},
            {"points", r.count}};
  };
  return {{"keys", list_of(study.statistics->by, key)},
          {"confidence", study.statistics->confidence},
          {"rows", list_of(sweep::group_statistics(store, study), row)}};
}

// ---------------------------------------------------------------- bifurcation diagram
constexpr double kMicrons = 1e6;  // um per m

json points_json(const std::vector<BranchPoint>& points, const sweep::Sample& sample,
                 double per_si) {
  return list_of(points, [&](const BranchPoint& point) -> json {
    const std::size_t shown =
        point.period > 0
            ? std::min<std::size_t>(static_cast<std::size_t>(point.period), point.places.size())
            : point.places.size();
    std::vector<double> x, y;
    for (std::size_t k = point.places.size() - shown; k < point.places.size(); ++k) {
      x.push_back(kMicrons * point.places[k].real());
      y.push_back(kMicrons * point.places[k].imag());
    }
    return {{"value", per_si * *sample.at(point.point).front().number},
            {"refused", point.refused},
            {"continued", point.continued},
            {"x", x},
            {"y", y},
            {"period", point.period},
            {"exponent", number_or_null(point.exponent)}};
  });
}

std::string note_of(const sweep::Bifurcation& diagram) {
  if (!diagram.not_continued.empty())
    return fmt::format("Each value begins at the scene's own start: {}.", diagram.not_continued);
  const auto begun = [](const std::vector<BranchPoint>& points) {
    return std::count_if(points.begin(), points.end(), [](const BranchPoint& point) {
      return point.refused.empty() && !point.continued;
    });
  };
  const auto refused = std::count_if(diagram.up.begin(), diagram.up.end(),
                                     [](const BranchPoint& p) { return !p.refused.empty(); });
  std::string note = "Each value begins where the one before it ended";
  const auto again = begun(diagram.up) + begun(diagram.down) - 2;
  if (again > 0)
    note += fmt::format(", but for {} that could not and began at the scene's own start", again);
  if (refused > 0) note += fmt::format("; {} of {} values have no run", refused, diagram.up.size());
  return note + ".";
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
  // Row i of a whole grid's plots is point i.
  if (linear.any() && plots["kind"] == "grid" && plots["status"].size() == linear.points.size())
    plots["linear"] = rub_columns(linear.points);
  return shortened({{"name", study.scene.stem().string()},
                    {"answer", sweep::answer_of(store, study)},
                    {"linear_refused", linear.refused},
                    {"plots", std::move(plots)}});
}

json bifurcation_data(const sweep::Study& study, const sweep::Sample& sample,
                      const sweep::Bifurcation& diagram) {
  const sweep::Vary& vary = study.vary.front();
  const ShownUnit unit = shown_unit(vary.unit);
  return shortened(
      {{"key",
        {{"name", vary.key}, {"unit", unit.name}, {"log", vary.spacing == sweep::Spacing::kLog}}},
       {"up", points_json(diagram.up, sample, unit.per_si)},
       {"down", points_json(diagram.down, sample, unit.per_si)},
       {"note", note_of(diagram)}});
}

std::string sweep_page(const sweep::PointScenes& scenes, sweep::Store& store,
                       const sweep::Study& study, const json& kept, const PointRuns& runs,
                       const json& bifurcation) {
  Section found;
  for (const std::string sentence : kept.at("answer"))
    found.parts.emplace_back(Sentence{.text = sentence});
  json plots = kept.at("plots");
  plots["runs"] = runs_json(runs, scenes.sample().size());
  json data{{"maps", {plots}},
            {"linear_refused", kept.at("linear_refused")},
            {"statistics", statistics_json(store, study)},
            {"failed", failures_json(store, study)},
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
