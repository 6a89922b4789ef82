// The maps of linear analyses: of the rubs that last, and of the feedback that calms them. Drawn by
// page/maps.js, beside the runs of a sweep or on pages of their own (page/map_page.html).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/modes/rub_key_map.h"
#include "native_model/linear/rub_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

inline constexpr const char* kLinearAttractors = "linear: attractors";
inline constexpr const char* kLinearGrowth = "linear: rub, growth rate";

// The figures of a rub: [{"name", "unit", "meaning", "word": of few different texts, "linear":
// true, it has a value whether a run succeeds or not, "signed": colours part at 0}].
nlohmann::json rub_figures();
// The values in that order; null where the point has no such rub.
std::vector<nlohmann::json> rub_values(const rub::RubPoint& point);

// The maps of a page, as page/map.html takes them: the figure that each shows first.
nlohmann::json figure_choices(const std::vector<std::string>& first);

// The page of `rotorub modes --rub-map`: over two keys what is stable, how fast it
// decays or grows, and how hard it presses.
std::string rub_map_page(const scene::Scene& scene, const RubKeyMap& map);
// The page of `rotorub modes --feedback-map`: over spin speed and cross-coupled feedback k how fast
// the forced rub decays and how hard it presses, and the rule k(Omega) as a table and as a scene's
// keys.
std::string feedback_map_page(const scene::Scene& scene, const rub::FeedbackMap& map);

// What the pages' script draws: as sweep_plots (sweep_page.h), a grid, the second key fastest.
nlohmann::json rub_map_plots(const RubKeyMap& map);
nlohmann::json feedback_map_plots(const rub::FeedbackMap& map);

}  // namespace rotorub
