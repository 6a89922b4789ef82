// What the report's template shows of one scene: texts, already worded and rounded.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// Everything but films, plots and the scene's number.
nlohmann::json scene_values(const SceneComparison& comparison);

}  // namespace rotorub
