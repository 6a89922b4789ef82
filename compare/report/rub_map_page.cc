#include "compare/report/rub_map_page.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "compare/modes/rub_analysis.h"
#include "compare/modes/units.h"
#include "compare/report/assets.h"
#include "compare/report/page_frame.h"
#include "compare/report/rounded.h"
#include "compare/report/rub_figures.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;
using rub::RubMap;


json key(const char* name, const char* unit, const std::vector<double>& values, double per_si) {
  json list = json::array();
  for (const double value : values) list.push_back(rounded(value * per_si, kDigits));
  return {{"name", name}, {"unit", unit}, {"even", true}, {"log", false}, {"values", list}};
}

json card(const char* title, const std::string& headline, const std::string& text) {
  return {{"title", title}, {"tone", ""}, {"headline", headline}, {"text", text}};
}

std::string share(int count, const RubMap& map) {
  return fmt::format("{:.3g} %", 100.0 * count / static_cast<double>(map.points.size()));
}

// How much of the map each attractor holds, and how much has none.
json cards_of(const RubMap& map) {
  std::array<int, 16> met{};
  for (const rub::RubPoint& point : map.points) ++met[point.attractors()];
  json cards = json::array();
  const auto add = [&](unsigned bit, const char* title, const char* text) {
    int all = 0;
    for (unsigned k = 0; k < met.size(); ++k) all += k & bit ? met[k] : 0;
    cards.push_back(card(title, share(all, map), text));
  };
  add(rub::kForcedRub, "Synchronous rub stable", "the rotor slides round in step with its load");
  add(rub::kBackwardWhip, "Backward whip stable", "it slides round against the spin");
  add(rub::kRollingRub, "Rolling possible", "once there, it rolls round against the spin, and presses hard");
  cards.push_back(card("Nothing stable but rolling",
                       share(met[0] + met[rub::kRollingRub], map),
                       "a rotor that does not roll bounces for ever"));
  return cards;
}

}  // namespace

json rub_map_plots(const RubMap& map) {
  json figures = rub_figures(), columns = json::array(), values = {json::array(), json::array()};
  for (std::size_t k = 0; k < figures.size(); ++k) columns.push_back(json::array());
  json status = json::array();
  for (std::size_t s = 0; s < map.speeds.size(); ++s) {
    for (std::size_t f = 0; f < map.frictions.size(); ++f) {
      values[0].push_back(s);
      values[1].push_back(f);
      status.push_back(0);
      std::vector<json> row = rub_values(map.at(s, f));
      for (std::size_t k = 0; k < row.size(); ++k) columns[k].push_back(std::move(row[k]));
    }
  }
  return {{"kind", "grid"},
          {"keys", {key("spin speed", "Hz", map.speeds, kHz), key("friction", "", map.frictions, 1.0)}},
          {"figures", figures},
          {"values", values},
          {"columns", columns},
          {"status", status},
          {"statuses", {"ok"}},
          {"every", 1}};
}

std::string rub_map_page(const scene::Scene& scene, const RubMap& map) {
  const json plots = rub_map_plots(map);
  json values = page_frame({scene.name, "lasting rubs", "Which rubs last, and where?"}, sweep_js(),
                           plots);
  values["maps"] = figure_choices({kLinearAttractors, kLinearGrowth});
  values["cards"] = cards_of(map);
  values["figures"] = plots["figures"];
  values["text"] = scene.text;
  return fill_page(rub_map_html(), values);
}

}  // namespace rotorub
