#include "compare/report/bench_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "compare/bench/output.h"
#include "compare/bench/work_precision.h"
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

json card_of(const SceneBench& bench, const std::string& id) {
  std::optional<bool> native;  // empty if no level is reached
  for (const Level& level : bench.levels) {
    const std::optional<bool> here = native_is_fastest(level);
    if (in_headline(level) && here) native = native.value_or(true) && *here;
  }
  json shown = card(bench.scene.name, native ? *native ? "good" : "bad" : "part",
                    !native   ? "No engine reaches a level"
                    : *native ? "A native integrator at every level reached"
                              : "Not native at every level",
                    verdict_text(bench.levels));
  shown["link"] = "#" + id;
  return shown;
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
  const result::Section found = bench::result_of(machine, benches, restitution);
  json sections = page_json(found), cards = json::array();
  std::vector<std::string> names;
  for (std::size_t k = 0; k < benches.size(); ++k) {
    json& section = sections[k];
    json& parts = section["parts"];
    names.push_back(benches[k].scene.name);
    cards.push_back(card_of(benches[k], section["id"]));
    parts.insert(parts.begin(), json{{"plots", "bench"}, {"index", k}});
    parts.push_back({{"summary", "The scene's text"}, {"pre", benches[k].scene.text}});
  }
  const std::string lead = fmt::format(
      "Every engine on a ladder of steps (of tolerances, where it chooses its steps). An error is "
      "the largest distance of rotor or ring from the reference over the whole run; a time is the "
      "median of repeated whole integrations with the output off, all points in turns. Measured on "
      "{}, {}, one thread each; {}; MuJoCo {}.",
      machine.processor, machine.instructions, machine.compiler, machine.mujoco);
  sections.insert(sections.begin(), {{{"cards", cards}}, {{"lead", lead}}});
  return laid_out_page(
      {fmt::format("{}", fmt::join(names, ", ")), "speed against error",
       "Who is the fastest at a given error?"},
      found, sections, {{"benches", list_of(json_of(found).at("scenes"), precision_plots)}},
      "Peers get the contact of a disc in a ring (its normal from the present positions) from us; "
      "the solver is theirs. Native times hold the bookkeeping of energy and contact; those of "
      "MuJoCo and of the peers do not.");
}

}  // namespace rotorub
