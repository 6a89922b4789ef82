// The actuator of an auxiliary bearing's ring in a model, and the law that commands it.
#pragma once

#include <cstddef>

#include "native_model/model/model.h"

namespace rotorub {

// Sets the actuator of auxiliary bearing k. Throws scene::SceneError for a force table that cannot
// be inverted.
void fill_actuator(const scene::Scene& scene, std::size_t k, Model& model);
// Sets the controller of auxiliary bearing k; needs the actuator, the masses and the initial state.
// Throws scene::SceneError if the law is unsuitable for the ring's support.
void fill_control(const scene::Scene& scene, std::size_t k, Model& model);

}  // namespace rotorub
