// What of a scene only the model shows to be wrong; everything else is refused with the scene's
// file. All of them throw scene::SceneError.
#pragma once

#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"
#include "native_model/system/model.h"

namespace rotorub {

[[noreturn]] void refuse(const scene::Scene& scene, std::vector<scene::Diagnostic> diagnostics);

void check_size(const scene::Scene& scene, int nq);
void check_unbalances(const scene::Scene& scene, std::size_t count);
// With max_frequency the length of these lists is known only now.
void check_initial_lists(const scene::Scene& scene, const Layout& layout);
// A mode with a node at the contact moves the contact point by nothing: that is known only now.
void check_initial_gap(const scene::Scene& scene, const Model& model);
// Within an electromagnet's core there is no start.
void check_initial_ring(const scene::Scene& scene);

}  // namespace rotorub
