// Maps of lasting rubs over spin speed and friction or over cross-coupled feedback, as JSON and
// text; and the plant of a scene for control design.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "compare/modes/rub_key_map.h"
#include "compare/result/result.h"
#include "native_model/control/quadratic.h"
#include "native_model/linear/rub_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// {"speeds": [rad/s], "frictions": [], "points": [...]}: rub_point_result of each point, with the
// friction varying fastest. For other keys, "across" and "up": {"key", "unit", "values"} replace
// the first two. A refused point is null.
nlohmann::json rub_map_json(const RubKeyMap& map);

// For people: a picture with the first key across and the second up, one letter for the set of
// possible rubs, and a legend with the share of each; a page has the legend alone.
result::Section rub_map_picture(const std::string& name, const RubKeyMap& map);

// {"speed", "states": [names], "inputs", "outputs", "A", "B", "C"}: rows of numbers, SI.
nlohmann::json state_space_json(const scene::Scene& scene, const LinearPlant& plant);

// {"speeds", "feedbacks", "growth": rows of 1/s or null, "stable", "frequency": of that pair in
// rad/s, "normal_force", "whip": whether a whip or rolling is stable beside it, "rule": [N s/m or
// null]}
nlohmann::json feedback_map_json(const rub::FeedbackMap& map);
// The rule as keys of a scene, on two lines; empty if no k is stable at any speed.
std::string feedback_keys(const rub::FeedbackMap& map);
// For people. One line per speed: the k at which the forced rub decays fastest, and the range of k
// in which it is stable; then feedback_keys.
result::Section feedback_map_table(const std::string& name, const rub::FeedbackMap& map);

}  // namespace rotorub
