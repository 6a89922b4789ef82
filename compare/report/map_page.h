// What the pages of the maps of linear analyses share (page/map_page.html, drawn by page/sweep.js).
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub {

// An axis of a map with even values; shown = value * per_si.
nlohmann::json map_key(std::string_view name, std::string_view unit,
                       const std::vector<double>& values, double per_si);
// A figure that has a value whether a run succeeds or not: word, of few different texts; is_signed,
// colours part at 0.
nlohmann::json map_figure(std::string_view name, std::string_view unit, std::string_view meaning,
                          bool word, bool is_signed);
// A short answer above the maps.
nlohmann::json map_card(std::string_view title, std::string_view headline, std::string_view text);
// Rounded as pages show it; null for what is not finite.
nlohmann::json map_number(double value);

// What the script draws (sweep_plots in sweep_page.h): a grid of two keys, the second runs fastest.
// row(i, j): the values of all figures there, in their order.
using MapRow = std::function<std::vector<nlohmann::json>(std::size_t i, std::size_t j)>;
nlohmann::json map_plots(const nlohmann::json& first, const nlohmann::json& second,
                         const nlohmann::json& figures, const MapRow& row);

struct MapPage {
  std::string topic, heading, lead;  // words above the maps
  std::string option;                // of rotorub modes
  std::vector<std::string> maps;     // the figure that each map shows first
};
// rule: null, or {"rows": [{"speed", "feedback", "from", "to", "decay", "force", "note"}], "keys"}.
std::string map_page(const scene::Scene& scene, const MapPage& map, const nlohmann::json& cards,
                     const nlohmann::json& plots, const nlohmann::json& rule);

}  // namespace rotorub
