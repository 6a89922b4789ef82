// The figures of a linear map of rubs as the maps' script (page/sweep.js) takes them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "native_model/rub/rub_map.h"

namespace rotorub {

// [{"name", "unit", "meaning", "word", "linear": true, "signed"}]
nlohmann::json rub_figures();
// The values in that order; null where the point has no such rub.
std::vector<nlohmann::json> rub_values(const rub::RubPoint& point);

}  // namespace rotorub
