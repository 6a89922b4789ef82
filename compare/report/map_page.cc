#include "compare/report/map_page.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report/assets.h"
#include "compare/report/page_frame.h"
#include "compare/report/rounded.h"
#include "compare/report/rub_figures.h"

namespace rotorub {

using nlohmann::json;

json map_number(double value) {
  return std::isfinite(value) ? json(rounded(value, kDigits)) : json(nullptr);
}

json map_key(std::string_view name, std::string_view unit, const std::vector<double>& values,
             double per_si) {
  json list = json::array();
  for (const double value : values) list.push_back(rounded(value * per_si, kDigits));
  return {{"name", name}, {"unit", unit}, {"even", true}, {"log", false}, {"values", list}};
}

json map_figure(std::string_view name, std::string_view unit, std::string_view meaning, bool word,
                bool is_signed) {
  return {{"name", name}, {"unit", unit},   {"meaning", meaning},
          {"word", word}, {"linear", true}, {"signed", is_signed}};
}

json map_card(std::string_view title, std::string_view headline, std::string_view text) {
  return {{"title", title}, {"tone", ""}, {"headline", headline}, {"text", text}};
}

json map_plots(const json& first, const json& second, const json& figures, const MapRow& row) {
  json columns(figures.size(), json::array()), values = {json::array(), json::array()};
  json status = json::array();
  for (std::size_t i = 0; i < first.at("values").size(); ++i) {
    for (std::size_t j = 0; j < second.at("values").size(); ++j) {
      values[0].push_back(i);
      values[1].push_back(j);
      status.push_back(0);
      std::vector<json> here = row(i, j);
      for (std::size_t k = 0; k < here.size(); ++k) columns[k].push_back(std::move(here[k]));
    }
  }
  return {{"kind", "grid"},     {"keys", {first, second}}, {"figures", figures}, {"values", values},
          {"columns", columns}, {"status", status},        {"statuses", {"ok"}}, {"every", 1}};
}

std::string map_page(const scene::Scene& scene, const MapPage& map, const json& cards,
                     const json& plots, const json& rule) {
  json values = page_frame({scene.name, map.topic, map.heading}, {{"maps", {plots}}});
  values["lead"] = map.lead;
  values["option"] = map.option;
  values["maps"] = figure_choices(map.maps);
  values["cards"] = cards;
  values["figures"] = plots.at("figures");
  values["rule"] = rule;
  values["text"] = scene.text;
  return fill_page(map_page_html(), values);
}

}  // namespace rotorub
