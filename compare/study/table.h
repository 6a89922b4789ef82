// A comparison as text for the terminal.
#pragma once

#include <optional>
#include <string>

#include "compare/base/palette.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// The answer, the figures side by side and their differences (in resync the contacts', onset by
// onset), the split of the judged ones, and a verdict with its reasons for each contact model; at
// most 80 columns wide.
std::string comparison_table(const SceneComparison& comparison, const Palette& palette = Palette());

// Whether rotor and ring touch in a run, from when on, how hard, and what becomes of it: the rest
// of a sentence that begins with "rubs: ". cut: s, where a run ended that was to go on.
std::string rub_answer(const Metrics& metrics, std::optional<double> cut = {});

// What `run` says of one run: that answer, then its figures.
std::string run_table(const scene::Scene& scene, const Trajectory& trajectory,
                      const Palette& palette = Palette());

}  // namespace rotorub
