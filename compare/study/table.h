// A comparison as text for the terminal.
#pragma once

#include <string>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// Figures side by side, the split of the judged differences, and a verdict with its reasons for
// each contact model; 96 columns with three contact models.
std::string comparison_table(const SceneComparison& comparison);

// What `run` says of one run.
std::string run_table(const scene::Scene& scene, const Trajectory& trajectory);

}  // namespace rotorub
