// The map of lasting rubs over spin speed and friction as JSON and as a picture of characters.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "native_model/rub/rub_map.h"

namespace rotorub {

// {"speeds": [rad/s], "frictions": [], "points": [...]}: rub_point_json of each, the friction
// fastest.
nlohmann::json rub_map_json(const rub::RubMap& map);

// Spin speed across, friction up, a letter for what may coexist, and their meaning.
std::string rub_map_picture(const std::string& name, const rub::RubMap& map);

}  // namespace rotorub
