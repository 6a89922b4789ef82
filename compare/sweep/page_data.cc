#include "compare/sweep/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/json.h"
#include "compare/base/plot_points.h"
#include "compare/base/units.h"
#include "compare/modes/rub_map_text.h"
#include "compare/sweep/answer.h"
#include "compare/sweep/group_statistics.h"
#include "compare/sweep/linear_map.h"

namespace rotorub::sweep {
namespace {

using nlohmann::json;

// The values of a key in a grid, in order.
json grid_values(const Vary& vary, double per_si) {
  if (!vary.values.empty()) {
    return list_of(vary.values, [&](const Value& value) {
      return value.number ? json(per_si * *value.number) : json(value.text);
    });
  }
  const auto last = static_cast<double>(vary.count - 1);
  json values = json::array();
  for (std::int64_t i = 0; i < vary.count; ++i) {
    const double share = vary.count > 1 ? static_cast<double>(i) / last : 0.0;
    values.push_back(per_si * between(vary, share));
  }
  return values;
}

json field(const Statement& row, int column, double per_si) {
  if (row.is_nothing(column)) return nullptr;
  if (row.is_text(column)) return row.text(column);
  return per_si * row.number(column);
}

json keys_of(const Study& study, bool grid) {
  return list_of(study.vary, [&](const Vary& vary) {
    const ShownUnit unit = shown_unit(vary.unit);
    json key = {{"name", vary.key},
                {"unit", unit.name},
                {"even", vary.values.empty() && vary.spacing == Spacing::kLinear},
                {"log", vary.spacing == Spacing::kLog}};
    if (grid) key["values"] = grid_values(vary, unit.per_si);
    return key;
  });
}

json figures_json() {
  return list_of(result_columns(), [](const ResultColumn& column) -> json {
    return {{"name", column.name},
            {"unit", shown_unit(column.unit).name},
            {"meaning", column.meaning},
            {"word", column.value({}).is_string()}};
  });
}

// The points that failed, by their reason: "first" is the number of the first one.
json failures_json(Store& store, const Study& study) {
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

// The rows of statistics.csv, SI; null if the study asks for none.
json statistics_json(Store& store, const Study& study) {
  if (!study.statistics) return nullptr;
  const auto key = [&](std::size_t k) {
    return name_and_unit(study.vary[k].key, study.vary[k].unit);
  };
  const auto row = [](const StatisticsRow& r) -> json {
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
          {"rows", list_of(group_statistics(store, study), row)}};
}

// ---------------------------------------------------------------- bifurcation diagram

json points_json(const std::vector<BranchPoint>& points, const Sample& sample, double per_si) {
  return list_of(points, [&](const BranchPoint& point) -> json {
    const std::size_t shown =
        point.period > 0
            ? std::min<std::size_t>(static_cast<std::size_t>(point.period), point.places.size())
            : point.places.size();
    std::vector<double> x, y;
    for (std::size_t k = point.places.size() - shown; k < point.places.size(); ++k) {
      x.push_back(kMicro * point.places[k].real());
      y.push_back(kMicro * point.places[k].imag());
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

json branch_point_json(const RubOnBranch& at, double per_si) {
  const std::vector<std::complex<double>> places = places_of(at.rub);
  const auto in_um = [&](double (*part)(const std::complex<double>&)) {
    return list_of(places, [part](const auto& place) { return json(kMicro * part(place)); });
  };
  const bool is_named = at.point != periodic::PointKind::kRegular;
  return {{"value", per_si * at.value},
          {"point", is_named ? json(to_string(at.point)) : json(nullptr)},
          {"kind", at.rub.kind},
          {"stable", at.rub.settled.motion.stable},
          {"multiplier", at.rub.largest_multiplier()},
          {"x", in_um([](const std::complex<double>& place) { return place.real(); })},
          {"y", in_um([](const std::complex<double>& place) { return place.imag(); })}};
}

json branches_json(const MotionBranches& branches, double per_si) {
  const json lines = list_of(branches.found.branches, [&](const RubBranch& branch) -> json {
    return {{"order", branch.points.front().rub.settled.order},
            {"starts", branch.starts},
            {"ends", {branch.first_end, branch.last_end}},
            {"points", list_of(branch.points, [&](const RubOnBranch& at) {
               return branch_point_json(at, per_si);
             })}};
  });
  return {{"refused", branches.refused.empty() ? json(nullptr) : json(branches.refused)},
          {"lines", lines}};
}

// A sentence with a space before it; empty if no branches were asked for.
std::string note_of(const std::optional<MotionBranches>& branches) {
  if (!branches) return "";
  if (!branches->refused.empty())
    return fmt::format(" There are no branches of periodic motions: {}.", branches->refused);
  return " Lines: branches of periodic motions, found by continuation; solid: stable, dashed: "
         "unstable.";
}

std::string note_of(const Bifurcation& diagram) {
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

json sweep_plots(const PointScenes& scenes, Store& store, const Study& study) {
  const std::int64_t every = (scenes.sample().size() + kMostDrawn - 1) / kMostDrawn;
  const bool grid = study.kind == SampleKind::kGrid && every == 1;
  const auto columns = result_columns();
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

json sweep_json(const PointScenes& scenes, Store& store, const Study& study) {
  json plots = sweep_plots(scenes, store, study);
  const LinearMap linear = linear_map(scenes);
  // Row i of a whole grid's plots is point i.
  if (linear.any() && plots["kind"] == "grid" && plots["status"].size() == linear.points.size())
    plots["linear"] = rub_columns(linear.points);
  return shortened({{"name", study.scene.stem().string()},
                    {"answer", answer_of(store, study)},
                    {"linear_refused", linear.refused},
                    {"plots", std::move(plots)}});
}

json bifurcation_data(const Study& study, const Sample& sample, const Bifurcation& diagram,
                      const std::optional<MotionBranches>& branches) {
  const Vary& vary = study.vary.front();
  const ShownUnit unit = shown_unit(vary.unit);
  return shortened(
      {{"key", {{"name", vary.key}, {"unit", unit.name}, {"log", vary.spacing == Spacing::kLog}}},
       {"up", points_json(diagram.up, sample, unit.per_si)},
       {"down", points_json(diagram.down, sample, unit.per_si)},
       {"branches", branches ? branches_json(*branches, unit.per_si) : json(nullptr)},
       {"note", note_of(diagram) + note_of(branches)}});
}

json page_data(const PointScenes& scenes, Store& store, const Study& study, const json& kept,
               const json& runs, const json& bifurcation) {
  json plots = kept.at("plots");
  plots["runs"] = runs;
  json data{{"maps", {plots}},
            {"linear_refused", kept.at("linear_refused")},
            {"statistics", statistics_json(store, study)},
            {"failed", failures_json(store, study)},
            {"texts", {study.text, scenes.scene_text()}}};
  if (!bifurcation.is_null()) data["bifurcation"] = bifurcation;
  return data;
}

}  // namespace rotorub::sweep
