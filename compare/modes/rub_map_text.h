// Maps of lasting rubs over two keys or over cross-coupled feedback, as JSON and text, and the
// plant of a scene for control design. README.md lists the keys of their JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/modes/rub_key_map.h"
#include "compare/result/result.h"
#include "native_model/control/quadratic.h"
#include "native_model/linear/levitation.h"
#include "native_model/linear/rub_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// rub_point_result of each point, with the second key varying fastest; null where refused.
nlohmann::json rub_map_json(const RubKeyMap& map);

// For the maps of pages, one list per figure of a rub, in SI units, with a value for each point:
// "attractors", "rub_growth", "rub_frequency", "rub_force", "whip_growth", "whip_whirl",
// "whip_force", "rolling_force", "free_orbit" (in clearances). A value is null if the point has no
// such rub.
nlohmann::json rub_columns(const std::vector<std::optional<rub::RubPoint>>& points);

// For people: a picture with the first key across and the second up, one letter for the set of
// possible rubs, and a legend with the share of each; a page has the legend alone.
result::Section rub_map_picture(const std::string& name, const RubKeyMap& map);

nlohmann::json state_space_json(const scene::Scene& scene, const LinearPlant& plant);
nlohmann::json state_space_json(const scene::Scene& scene, const MagneticPlant& plant);

// The rule as keys of a scene, on two lines; empty if no k is stable at any speed.
std::string feedback_keys(const rub::FeedbackMap& map);
// "feedback_map" in JSON. For people one line per speed: the k at which the forced rub decays
// fastest, and the range of k in which it is stable; then feedback_keys.
result::Section feedback_map_result(const std::string& name, const rub::FeedbackMap& map);

}  // namespace rotorub
