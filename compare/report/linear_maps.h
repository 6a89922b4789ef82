// What the pages of the maps of linear analyses share (page/map_page.html, drawn by page/sweep.js).
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/rub/feedback_map.h"
#include "native_model/rub/rub_map.h"
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

// The figures of a linear map of rubs as the maps' script (page/sweep.js) takes them.

inline constexpr const char* kLinearAttractors = "linear: attractors";
inline constexpr const char* kLinearGrowth = "linear: rub, growth rate";

// [{"name", "unit", "meaning", "word", "linear": true, "signed"}]
nlohmann::json rub_figures();
// The values in that order; null where the point has no such rub.
std::vector<nlohmann::json> rub_values(const rub::RubPoint& point);

// The maps of a page, as page/map.html takes them: the figure that each shows first.
nlohmann::json figure_choices(const std::vector<std::string>& first);

// The page of `rotorub modes --rub-map`: one HTML file with everything in it. Maps over spin speed
// and friction of what is stable, how fast it decays or grows, and how hard it presses.

std::string rub_map_page(const scene::Scene& scene, const rub::RubMap& map);

// What the page's script draws: as sweep_plots (sweep_page.h), a grid.
nlohmann::json rub_map_plots(const rub::RubMap& map);

// The page of `rotorub modes --feedback-map`: maps over spin speed and cross-coupled feedback k of
// how fast the forced rub decays and how hard it presses, and the rule k(Omega) as a table and as a
// scene's keys.

std::string feedback_map_page(const scene::Scene& scene, const rub::FeedbackMap& map);

// What the page's script draws: as sweep_plots (sweep_page.h), a grid.
nlohmann::json feedback_map_plots(const rub::FeedbackMap& map);

}  // namespace rotorub
