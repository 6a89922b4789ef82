// Makes the model of a scene with the start that the scene requests: the lists of [initial], the
// steady free orbit (orbit_start.h) or a lasting rub (rub_start.h). Every program makes its model
// here.
#pragma once

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Throws scene::SceneError as make_model, add_orbit_start and rub::add_rub_start do.
Model prepare(const scene::Scene& scene);

}  // namespace rotorub
