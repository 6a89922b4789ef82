// What moves the ring of an auxiliary bearing in a model: its actuator, and the law that commands
// that.
#pragma once

#include <cstddef>

#include "native_model/model/model.h"

namespace rotorub {

// Of auxiliary bearing k. Throws scene::SceneError for a table of forces that has no inverse.
void fill_actuator(const scene::Scene& scene, std::size_t k, Model& model);
// After the actuator, masses and initial state. Throws scene::SceneError for a law that the ring's
// support does not suit.
void fill_control(const scene::Scene& scene, std::size_t k, Model& model);

}  // namespace rotorub
