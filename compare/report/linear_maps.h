// The maps of linear analyses: of lasting rubs, and of feedback that stabilises them. page/maps.js
// draws them, beside the runs of a sweep or on their own pages.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/modes/rub_key_map.h"
#include "native_model/linear/rub_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// The figures of a rub: [{"name", "unit", "meaning", "word": it has few different texts, "linear":
// true, it has a value even if a run fails, "signed": the colours change at 0}].
nlohmann::json rub_figures();
// The values in that order; null if the point has no such rub.
std::vector<nlohmann::json> rub_values(const rub::RubPoint& point);

// The page of `rotorub modes --rub-map`: over two keys, which rubs are stable, how fast they decay
// or grow, and their normal force.
std::string rub_map_page(const scene::Scene& scene, const RubKeyMap& map);
// The page of `rotorub modes --feedback-map`: over spin speed and cross-coupled feedback k, how
// fast the forced rub decays and its normal force; and the rule k(Omega) as a table and as keys of
// a scene.
std::string feedback_map_page(const scene::Scene& scene, const rub::FeedbackMap& map);

// The data of the maps: a grid as in sweep_plots (sweep_page.h), with the second key varying
// fastest.
nlohmann::json rub_map_plots(const RubKeyMap& map);
nlohmann::json feedback_map_plots(const rub::FeedbackMap& map);

}  // namespace rotorub
