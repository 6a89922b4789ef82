// Sentences on why two runs differ, derived by fixed rules.
#pragma once

#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The most important reason first. `model` is one of the comparison's, with its figures.
std::vector<std::string> reasons(const SceneComparison& comparison, const ComparedModel& model);

// "coulomb agrees with the native model within 1 %: its contact forces can be trusted here."
std::string headline(const SceneComparison& comparison, const ComparedModel& model);

}  // namespace rotorub
