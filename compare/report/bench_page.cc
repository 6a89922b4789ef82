#include "compare/report/bench_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/units.h"
#include "compare/bench/output.h"
#include "compare/bench/work_precision.h"
#include "compare/report/assets.h"
#include "compare/report/page_frame.h"
#include "compare/report/precision_plots.h"

namespace rotorub {
namespace {

using namespace bench;
using nlohmann::json;

const BenchEngine& engine_of(const SceneBench& bench, const std::string& name) {
  return *std::find_if(bench.engines.begin(), bench.engines.end(),
                       [&](const BenchEngine& e) { return e.name == name; });
}

// ------------------------------------------------------------------ tables
json level_row(const Level& level, const std::vector<Point>& points) {
  json row = {{"level", fmt::format("{:.0e}", level.share)},
              {"fastest", "none reaches it"},
              {"setting", ""},
              {"ms", ""},
              {"others", level.judged ? "" : "at the reference's own error"},
              {"tone", ""}};
  if (level.engines.empty()) return row;
  const Best& first = level.engines.front();
  std::string others;
  for (std::size_t k = 1; k < level.engines.size(); ++k) {
    others += fmt::format("{}{} ×{:.3g}", k > 1 ? ", " : "", level.engines[k].engine,
                          level.engines[k].seconds / first.seconds);
  }
  row["fastest"] = first.engine;
  row["setting"] = setting_text(points[first.point].setting);
  row["ms"] = short_number(kMilli * first.seconds);
  row["others"] = others.empty() ? "alone" : others;
  row["tone"] = *native_is_fastest(level) ? "good" : "bad";
  return row;
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
  switch (cell.judgement.outcome) {
    case Outcome::kOk:
      return {{"word", "fine"}, {"tone", "good"}, {"reason", ""}};
    case Outcome::kChatter:
      return {{"word", "chatter"}, {"tone", ""}, {"reason", cell.judgement.reason}};
    case Outcome::kWrongAttractor:
      return {{"word", "wrong"}, {"tone", "bad"}, {"reason", cell.judgement.reason}};
    case Outcome::kDiverged:
      return {{"word", "diverged"}, {"tone", "bad"}, {"reason", cell.judgement.reason}};
    case Outcome::kRefused:
      return {{"word", "refused"}, {"tone", ""}, {"reason", cell.judgement.reason}};
  }
  return {};
}

// One table a friction; one row a contact model and stiffness.
json map_tables(const StabilityMap& map) {
  json tables = json::array();
  std::size_t at = 0;
  for (const double friction : map.frictions) {
    json rows = json::array(), steps = json::array();
    for (const double step : map.steps) steps.push_back(time_text(step));
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
    tables.push_back({{"friction", short_number(friction)}, {"steps", steps}, {"rows", rows}});
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
  json levels = json::array(), series = json::array();
  bool native = true, limits = false;
  for (const Level& level : bench.levels) {
    levels.push_back(level_row(level, bench.points));
    if (in_headline(level)) native = native && native_is_fastest(level).value_or(true);
  }
  for (const Series& s : series_of(bench.points, bench.telling_errors())) {
    series.push_back(series_row(s, bench.points));
    const bool mujoco = engine_of(bench, s.engine).family == Family::kMujoco;
    for (const std::size_t k : s.points) limits = limits || (mujoco && bench.points[k].limit_error);
  }
  const std::string verdict = verdict_text(bench.levels);
  return {{"name", bench.scene.name},
          {"id", fmt::format("scene-{}", index + 1)},
          {"index", index},
          {"tone", native ? "good" : "bad"},
          {"headline",
           native ? "A native integrator at every level reached" : "Not native at every level"},
          {"text", verdict},
          {"verdict", verdict},
          {"end", time_text(bench.scene.run.end)},
          {"clearance", fmt::format("{:.4g} mm", kMilli * bench.scene.first().contact->clearance)},
          {"source", bench.reference.source},
          {"reference_error", fmt::format("{:.1e} m", bench.reference.error)},
          {"attractor", rotorub::to_string(settled(bench.reference.trajectory).attractor)},
          {"levels", levels},
          {"series", series},
          {"has_limits", limits},
          {"has_map", bench.stability.has_value()},
          {"maps", bench.stability ? map_tables(*bench.stability) : json::array()},
          {"text_of_scene", bench.scene.text}};
}

}  // namespace

std::string bench_page(const Machine& machine, const std::vector<SceneBench>& benches,
                       const std::vector<RestitutionRow>& restitution) {
  json scenes = json::array(), plots = json::array(), engines = json::array();
  const json kept = bench_json(machine, benches, restitution);
  for (const json& scene : kept.at("scenes")) plots.push_back(precision_plots(scene));
  std::string names;
  for (const SceneBench& bench : benches) {
    names += (names.empty() ? "" : ", ") + bench.scene.name;
    scenes.push_back(scene_values(bench, scenes.size()));
  }
  for (const BenchEngine& e : bench_engines()) {
    engines.push_back(
        {{"name", e.name}, {"what", e.missing.empty() ? e.what : "not here: " + e.missing}});
  }
  json values = page_frame({names, "speed against error", "Who is the fastest at a given error?"},
                           {{"benches", plots}});
  values["scenes"] = scenes;
  values["engines"] = engines;
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
