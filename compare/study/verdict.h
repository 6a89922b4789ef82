// Why two runs differ, in sentences, by stated rules.
#pragma once

#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The most telling first. `comparison` has its sides and its twin filled in; `side`: of them, >= 1.
std::vector<std::string> reasons(const SceneComparison& comparison, std::size_t side,
                                 const SideDifference& difference);

// "coulomb agrees with the native model within 1 %: its contact forces can be trusted here."
std::string headline(const SceneComparison& comparison, const Side& other,
                     const SideDifference& difference);

}  // namespace rotorub
