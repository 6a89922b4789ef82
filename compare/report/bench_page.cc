#include "compare/report/bench_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>

#include "compare/base/format.h"
#include "compare/base/units.h"
#include "compare/bench/output.h"
#include "compare/bench/work_precision.h"
#include "compare/report/assets.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/result/result.h"

namespace rotorub {

namespace {

using namespace bench;
using nlohmann::json;

double number(const json& value) {
  return value.is_null() ? 0.0 : rounded(value.get<double>(), kDigits);
}

json plot_point(const json& point) {
  const json &step = point.at("step"), &wall = point.at("wall_ms");
  Setting setting{point.at("engine"), point.at("setting"), {}, nullptr, nullptr, ""};
  if (!step.is_null()) setting.step = step.get<double>();
  return {{"step", step.is_null() ? json(0.0) : step},
          {"label", setting_text(setting)},
          {"error", number(point.at("position_error"))},
          {"limit", number(point.at("limit_error"))},
          {"ms", wall.is_null() ? 0.0 : number(wall.at("median"))},
          {"low", wall.is_null() ? 0.0 : number(wall.at("low"))},
          {"high", wall.is_null() ? 0.0 : number(wall.at("high"))},
          {"outcome", point.at("outcome")}};
}

// The tolerances of an engine form one series (compare/bench/work_precision.h).
bool belongs(const json& point, const json& series) {
  return point.at("engine") == series.at("engine") &&
         (point.at("step").is_null() ? series.at("setting") == ""
                                     : point.at("setting") == series.at("setting"));
}

std::string family_of(const json& scene, const json& engine) {
  const json& engines = scene.at("engines");
  const auto found = std::find_if(engines.begin(), engines.end(),
                                  [&](const json& e) { return e.at("engine") == engine; });
  return found == engines.end() ? std::string("peer") : found->at("family").get<std::string>();
}

const BenchEngine& engine_of(const SceneBench& bench, const std::string& name) {
  return *std::find_if(bench.engines.begin(), bench.engines.end(),
                       [&](const BenchEngine& e) { return e.name == name; });
}

// ------------------------------------------------------------------ tables
json level_row(const Level& level, const std::vector<Point>& points) {
  const std::string share = fmt::format("{:.0e}", level.share);
  if (level.engines.empty()) {
    return {{"level", share},
            {"fastest", "none reaches it"},
            {"setting", ""},
            {"ms", ""},
            {"others", level.judged ? "" : "at the reference's own error"},
            {"tone", ""}};
  }
  const Best& first = level.engines.front();
  std::vector<std::string> others;
  for (const Best& other : std::span(level.engines).subspan(1))
    others.push_back(fmt::format("{} ×{:.3g}", other.engine, other.seconds / first.seconds));
  return {{"level", share},
          {"fastest", first.engine},
          {"setting", setting_text(points[first.point].setting)},
          {"ms", short_number(kMilli * first.seconds)},
          {"others", others.empty() ? "alone" : fmt::format("{}", fmt::join(others, ", "))},
          {"tone", *native_is_fastest(level) ? "good" : "bad"}};
}

json series_row(const Series& s, const std::vector<Point>& points) {
  return {{"engine", s.engine},
          {"setting", s.setting},
          {"order", s.order ? fmt::format("{:.2f}", *s.order) : "–"},
          {"us", s.us_per_step > 0.0 ? short_number(s.us_per_step) : "–"},
          {"least", s.best ? fmt::format("{:.1e}", points[*s.best].errors->position) : "–"},
          {"outcomes", outcomes_text(s)},
          {"reason", s.reason}};
}

json cell_values(const StabilityCell& cell) {
  const auto [word, tone] = [&]() -> std::pair<const char*, const char*> {
    switch (cell.judgement.outcome) {
      case Outcome::kOk:
        return {"fine", "good"};
      case Outcome::kChatter:
        return {"bouncing", ""};
      case Outcome::kWrongAttractor:
        return {"wrong", "bad"};
      case Outcome::kDiverged:
        return {"diverged", "bad"};
      case Outcome::kRefused:
        break;
    }
    return {"refused", ""};
  }();
  const bool fine = cell.judgement.outcome == Outcome::kOk;
  return {{"word", word}, {"tone", tone}, {"reason", fine ? "" : cell.judgement.reason}};
}

// One table per friction; one row per contact model and stiffness.
json map_tables(const StabilityMap& map) {
  json tables = json::array();
  std::size_t at = 0;
  for (const double friction : map.frictions) {
    json rows = json::array();
    while (at < map.cells.size() && map.cells[at].friction == friction) {
      const StabilityCell& first = map.cells[at];
      json cells = json::array();
      for (std::size_t k = 0; k < map.steps.size() && at < map.cells.size(); ++k, ++at) {
        cells.push_back(cell_values(map.cells[at]));
      }
      rows.push_back(
          {{"engine", first.engine},
           {"stiffness", first.stiffness > 0.0 ? fmt::format("{:g}", first.stiffness) : "–"},
           {"cells", cells}});
    }
    tables.push_back({{"friction", short_number(friction)},
                      {"steps", list_of(map.steps, time_text)},
                      {"rows", rows}});
  }
  return tables;
}

json restitution_values(const std::vector<RestitutionRow>& rows) {
  json table = json::array();
  for (const RestitutionRow& r : rows) {
    const std::string asked = fmt::format("{:.1f}", r.asked);
    if (table.empty() || table.back()["asked"] != asked) {
      table.push_back({{"asked", asked}, {"cells", json::array()}});
    }
    table.back()["cells"].push_back(r.failure.empty() ? fmt::format("{:.4f}", r.got) : r.failure);
  }
  return table;
}

json contenders(const std::vector<RestitutionRow>& rows) {
  json names = json::array();
  for (const RestitutionRow& r : rows) {
    if (r.asked != rows.front().asked) break;
    names.push_back(r.setting.empty() ? r.engine : r.engine + ", " + r.setting);
  }
  return names;
}

json scene_values(const SceneBench& bench, std::size_t index) {
  std::optional<bool> native;  // empty if no level is reached
  bool limits = false;
  for (const Level& level : bench.levels) {
    const std::optional<bool> here = native_is_fastest(level);
    if (in_headline(level) && here) native = native.value_or(true) && *here;
  }
  const std::vector<Series> series = series_of(bench.points, bench.telling_errors());
  for (const Series& s : series) {
    const bool mujoco = engine_of(bench, s.engine).family == Family::kMujoco;
    for (const std::size_t k : s.points) limits = limits || (mujoco && bench.points[k].limit_error);
  }
  const std::string verdict = verdict_text(bench.levels);
  return {
      {"name", bench.scene.name},
      {"id", fmt::format("scene-{}", index + 1)},
      {"index", index},
      {"tone", !native   ? "part"
               : *native ? "good"
                         : "bad"},
      {"headline", !native   ? "No engine reaches a level"
                   : *native ? "A native integrator at every level reached"
                             : "Not native at every level"},
      {"text", verdict},
      {"verdict", verdict},
      {"end", time_text(bench.scene.run.end)},
      {"clearance", fmt::format("{:.4g} mm", kMilli * bench.clearance())},
      {"source", bench.reference.source},
      {"reference_error", fmt::format("{:.1e} m", bench.reference.error)},
      {"attractor", rotorub::to_string(settled(bench.reference.trajectory).attractor)},
      {"levels", list_of(bench.levels, [&](const Level& l) { return level_row(l, bench.points); })},
      {"series", list_of(series, [&](const Series& s) { return series_row(s, bench.points); })},
      {"has_limits", limits},
      {"has_map", bench.stability.has_value()},
      {"maps", bench.stability ? map_tables(*bench.stability) : json::array()},
      {"text_of_scene", bench.scene.text}};
}

}  // namespace

json precision_plots(const json& scene) {
  const json all = list_of(scene.at("series"), [&](const json& series) -> json {
    json points = json::array();
    for (const json& point : scene.at("points")) {
      if (belongs(point, series) && !point.at("position_error").is_null())
        points.push_back(plot_point(point));
    }
    const json& order = series.at("order");
    return {{"engine", series.at("engine")},
            {"setting", series.at("setting")},
            {"family", family_of(scene, series.at("engine"))},
            {"order", order.is_null() ? order : json(number(order))},
            {"points", points}};
  });
  return {{"clearance", scene.at("clearance")}, {"series", all}};
}

std::string bench_page(const Machine& machine, const std::vector<SceneBench>& benches,
                       const std::vector<RestitutionRow>& restitution) {
  const json kept = json_of(bench::result_of(machine, benches, restitution));
  json scenes = json::array();
  std::vector<std::string> names;
  for (const SceneBench& bench : benches) {
    names.push_back(bench.scene.name);
    scenes.push_back(scene_values(bench, scenes.size()));
  }
  json values = page_frame({fmt::format("{}", fmt::join(names, ", ")), "speed against error",
                            "Who is the fastest at a given error?"},
                           {{"benches", list_of(kept.at("scenes"), precision_plots)}});
  values["scenes"] = scenes;
  values["engines"] = list_of(bench_engines(), [](const BenchEngine& e) -> json {
    return {{"name", e.name}, {"what", e.missing.empty() ? e.what : "not here: " + e.missing}};
  });
  values["has_restitution"] = !restitution.empty();
  values["restitution"] = restitution_values(restitution);
  values["contenders"] = contenders(restitution);
  values["processor"] = machine.processor;
  values["instructions"] = machine.instructions;
  values["compiler"] = machine.compiler;
  values["mujoco_version"] = machine.mujoco;
  return fill_page(bench_html(), values);
}

}  // namespace rotorub
