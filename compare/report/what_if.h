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

// [{"key", "also": keys that change with it, "unit", "value", "low", "high" (all in the unit),
// "meaning"}], for --set and for people. The range is the schema's if it has two ends, otherwise
// from 0 or a quarter of the value to twice the value. Empty for a scene that the module cannot
// run: one with libraries or without text.
nlohmann::json sliders_of(const scene::Scene& scene);

// {"name": the scene's file, "sliders"}; null without sliders, and if the module was not built.
nlohmann::json what_if_data(const scene::Scene& scene);

}  // namespace rotorub
