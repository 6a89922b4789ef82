// The model of a scene for a search of periodic motions: its sampled controls repeat with the
// loads.
#pragma once

#include <functional>

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// given: the model of the scene. make: makes the model of another scene in the same way. Each
// sampled control gets the sample time nearest to its own that divides the period of the loads
// (periodic::whole_sample_time), as if the clock of its processor ran a little faster or slower.
// Its delay keeps its number of samples, and its law is made for both. The memories of the rings'
// controllers are states, with exact sensors (with_control_states).
Model repeating_model(const scene::Scene& scene, Model given,
                      const std::function<Model(const scene::Scene&)>& make);

}  // namespace rotorub
