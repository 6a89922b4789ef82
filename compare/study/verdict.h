// Sentences on why two runs differ, derived by fixed rules.
#pragma once

#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The most important reason first. `comparison` needs its sides and its twin; side: index in its
// sides, >= 1.
std::vector<std::string> reasons(const SceneComparison& comparison, std::size_t side,
                                 const SideDifference& difference);

// "coulomb agrees with the native model within 1 %: its contact forces can be trusted here."
std::string headline(const SceneComparison& comparison, const Side& other,
                     const SideDifference& difference);

}  // namespace rotorub
