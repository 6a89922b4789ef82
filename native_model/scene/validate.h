// What single keys cannot show: combinations that contradict each other, and the defaults that
// depend on other keys.
#pragma once

#include <vector>

#include "native_model/scene/record.h"
#include "native_model/scene/scene.h"

namespace rotorub::scene {

// Adds every contradiction to `diagnostics`. Keys that are already known to be faulty are left out.
void validate(const Scene& scene, const Record& record, std::vector<Diagnostic>& diagnostics);

// Fills in what follows from other keys: G from nu, lists of the modal form to their length, the
// damping of torsion, output_times in order. Only for a scene without diagnostics.
void complete(Scene& scene, const Record& record);

}  // namespace rotorub::scene
