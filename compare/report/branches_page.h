// The page of `rotorub modes --periodic --across`.
#pragma once

#include <string>

#include "compare/modes/rub_branches.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// Branches of periodic rubs over a key: plots (page/bifurcation.js), named points, and starts
// without a periodic rub. Its data is "branches": `rub_branches` (modes/rub_branches_text.h), where
// the axes also have a "name", and "unit" and "per_si" as people read them.
std::string branches_page(const scene::Scene& scene, const RubBranches& all);

}  // namespace rotorub
