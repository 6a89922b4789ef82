// Maps of lasting rubs, over spin speed and friction or cross-coupled feedback, as JSON and text;
// and the plant that a control engineer asks of a scene.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "compare/modes/rub_key_map.h"
#include "native_model/control/quadratic.h"
#include "native_model/linear/rub_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// {"speeds": [rad/s], "frictions": [], "points": [...]}: rub_point_json of each, the friction
// fastest. Of other keys "across" and "up": {"key", "unit", "values"} in the place of the two; a
// point that is refused is null.
nlohmann::json rub_map_json(const RubKeyMap& map);

// The first key across, the second up, a letter for what may coexist, and their meaning.
std::string rub_map_picture(const std::string& name, const RubKeyMap& map);

// {"speed", "states": [names], "inputs", "outputs", "A", "B", "C"}: rows of numbers, SI.
nlohmann::json state_space_json(const scene::Scene& scene, const LinearPlant& plant);

// {"speeds", "feedbacks", "growth": rows of 1/s or null, "stable", "normal_force", "rule": [N s/m
// or null]}
nlohmann::json feedback_map_json(const rub::FeedbackMap& map);
// The rule as a scene's keys, two lines; empty where no k is stable at any speed.
std::string feedback_keys(const rub::FeedbackMap& map);
// A line a speed: the k under which the forced rub decays fastest, and from where to where it is
// stable; then feedback_keys.
std::string feedback_map_table(const std::string& name, const rub::FeedbackMap& map);

}  // namespace rotorub
