// A scene's magnetic bearings as parts of a model: springs, feedbacks, samplers.
#pragma once

#include <vector>

#include "native_model/model/model.h"

namespace rotorub {

// Each bearing's own sampled control, then the one that some share; `bearings` among the scene's,
// and nothing placed yet. Opens the library of [magnetic_control].
std::vector<SampledFeedback> magnetic_samplers(const scene::Scene& scene);
// Layout::integrals.
int feedback_states(const scene::Scene& scene, const std::vector<SampledFeedback>& samplers);

// shapes: of each bearing of the scene. The layout, the diagonals, and the samplers as
// magnetic_samplers() gives them are there already.
void add_magnetic_bearings(const scene::Scene& scene, const std::vector<MagnetShapes>& shapes,
                           Model& model);

}  // namespace rotorub
