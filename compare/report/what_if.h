// "What if", in the page: sliders of a scene's values, and the native model itself (report/live),
// which runs the scene again with what they say.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "native_model/scene/scene.h"

namespace rotorub {

// The module of report/live in base 64, gzip inside; of a scene that has sliders. Throws
// std::runtime_error where it cannot be read.
std::string native_module();

// [{"key", "also": keys that go with it, "unit", "value", "low", "high" (all in the unit),
// "meaning"}], for --set and for people; the range is the schema's where it has two ends, else from
// 0, or from a quarter of the value, to twice the value. Empty for a scene that the module cannot
// run: one with libraries, or without text.
nlohmann::json sliders_of(const scene::Scene& scene);

// {"text", "name": the scene's, "sliders"}; null without sliders, and where the module has not been
// built.
nlohmann::json what_if_data(const scene::Scene& scene);

}  // namespace rotorub
