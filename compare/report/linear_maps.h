// The lasting rubs over a map, for page/linear_maps.js, which draws them on a page of their own or
// beside the runs of a sweep.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "native_model/linear/rub_map.h"

namespace rotorub {

// One list per figure of a rub, in SI units, with a value for each point: "attractors",
// "rub_growth", "rub_frequency", "rub_force", "whip_growth", "whip_whirl", "whip_force",
// "rolling_force", "free_orbit" (in clearances). A value is null if the point has no such rub.
nlohmann::json rub_columns(const std::vector<std::optional<rub::RubPoint>>& points);

}  // namespace rotorub
