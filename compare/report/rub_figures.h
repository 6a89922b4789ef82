// The figures of a linear map of rubs as the maps' script (page/sweep.js) takes them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "native_model/rub/rub_map.h"

namespace rotorub {

inline constexpr const char* kLinearAttractors = "linear: attractors";
inline constexpr const char* kLinearGrowth = "linear: rub, growth rate";

// [{"name", "unit", "meaning", "word", "linear": true, "signed"}]
nlohmann::json rub_figures();
// The values in that order; null where the point has no such rub.
std::vector<nlohmann::json> rub_values(const rub::RubPoint& point);

// The maps of a page, as page/map.html takes them: the figure that each shows first.
nlohmann::json figure_choices(const std::vector<std::string>& first);

}  // namespace rotorub
