// "What if" in the page: sliders for a scene's values, and the native model itself (report/live),
// which reruns the scene with these values.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "native_model/scene/scene.h"

namespace rotorub {

// The module of report/live in base 64, with gzip inside, for pages of scenes with sliders. Throws
// std::runtime_error if it cannot be read.
std::string native_module();

// [{"key", "also": keys that change with it, "unit", "value", "low", "low_open", "high",
// "meaning"}] in SI, from which page/what_if.js makes sliders. low and high: the ends of the
// schema's range, null where it has none. Empty for a scene that the module cannot run: one with
// libraries or without text.
nlohmann::json sliders_of(const scene::Scene& scene);

// {"name": the scene's file, "sliders"}; null without sliders, and if the module was not built.
nlohmann::json what_if_data(const scene::Scene& scene);

}  // namespace rotorub
