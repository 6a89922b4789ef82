// The page of `rotorub modes --rub-map`: one HTML file with everything in it. Maps over spin speed
// and friction of what is stable, how fast it decays or grows, and how hard it presses.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "native_model/rub/rub_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

std::string rub_map_page(const scene::Scene& scene, const rub::RubMap& map);

// What the page's script draws: as sweep_plots (sweep_page.h), a grid.
nlohmann::json rub_map_plots(const rub::RubMap& map);

}  // namespace rotorub
