#include "compare/report/precision_plots.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/bench/work_precision.h"
#include "compare/report/rounded.h"

namespace rotorub {
namespace {

using nlohmann::json;

double number(const json& value) {
  return value.is_null() ? 0.0 : rounded(value.get<double>(), kDigits);
}

json plot_point(const json& point) {
  const json &step = point.at("step"), &wall = point.at("wall_ms");
  bench::Setting setting{point.at("engine"), point.at("setting"), {}, nullptr, nullptr, ""};
  if (!step.is_null()) setting.step = step.get<double>();
  return {{"step", step.is_null() ? json(0.0) : step},
          {"label", bench::setting_text(setting)},
          {"error", number(point.at("position_error"))},
          {"limit", number(point.at("limit_error"))},
          {"ms", wall.is_null() ? 0.0 : number(wall.at("median"))},
          {"low", wall.is_null() ? 0.0 : number(wall.at("low"))},
          {"high", wall.is_null() ? 0.0 : number(wall.at("high"))},
          {"outcome", point.at("outcome")}};
}

// Tolerances of one engine are one series (work_precision.h).
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

}  // namespace

json precision_plots(const json& scene) {
  json all = json::array();
  for (const json& series : scene.at("series")) {
    json points = json::array();
    for (const json& point : scene.at("points")) {
      if (belongs(point, series) && !point.at("position_error").is_null())
        points.push_back(plot_point(point));
    }
    const json& order = series.at("order");
    all.push_back({{"engine", series.at("engine")},
                   {"setting", series.at("setting")},
                   {"family", family_of(scene, series.at("engine"))},
                   {"order", order.is_null() ? order : json(number(order))},
                   {"points", points}});
  }
  return {{"clearance", scene.at("clearance")}, {"series", all}};
}

}  // namespace rotorub
