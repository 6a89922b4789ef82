// The magnetic bearings of a scene as parts of a model: springs, feedbacks, samplers.
#pragma once

#include <vector>

#include "native_model/model/model.h"

namespace rotorub {

// The sampled controls of single bearings, then the control that several bearings share. `bearings`
// are indices in the scene, and no coordinates are assigned yet. Opens the library of
// [magnetic_control].
std::vector<SampledFeedback> magnetic_samplers(const scene::Scene& scene);
// Number of coordinates for the states of feedbacks and samplers: Layout::feedback_states.
int feedback_states(const scene::Scene& scene, const std::vector<SampledFeedback>& samplers);

// shapes: one per magnetic bearing of the scene. The model must already have its layout, its
// diagonals and the samplers from magnetic_samplers().
void add_magnetic_bearings(const scene::Scene& scene, const std::vector<MagnetShapes>& shapes,
                           Model& model);

}  // namespace rotorub
