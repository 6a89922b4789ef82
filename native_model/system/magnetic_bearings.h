// A scene's magnetic bearings as parts of a model: springs, feedbacks, samplers.
#pragma once

#include <vector>

#include "native_model/system/model.h"

namespace rotorub {

// Layout::integrals.
int feedback_states(const scene::Scene& scene);

// shapes: of each bearing of the scene. The layout and the diagonals are there already.
void add_magnetic_bearings(const scene::Scene& scene, const std::vector<MagnetShapes>& shapes,
                           Model& model);

}  // namespace rotorub
