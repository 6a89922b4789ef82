// What a mode of compare adds to the JSON of a scene.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The shadow's figures and how far they are from the native ones; null figures and a reason without
// it.
nlohmann::json shadow_json(const SceneComparison& comparison);

// Rows and onsets of one contact model.
nlohmann::json resync_json(const Resync& resync);

}  // namespace rotorub
