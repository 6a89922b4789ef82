// The page of `rotorub modes --feedback-map`: maps over spin speed and cross-coupled feedback k of
// how fast the forced rub decays and how hard it presses, and the rule k(Omega) as a table and as a
// scene's keys.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "native_model/rub/rub_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

std::string feedback_map_page(const scene::Scene& scene, const rub::FeedbackMap& map);

// What the page's script draws: as sweep_plots (sweep_page.h), a grid.
nlohmann::json feedback_map_plots(const rub::FeedbackMap& map);

}  // namespace rotorub
