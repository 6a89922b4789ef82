// A comparison as text for the terminal.
#pragma once

#include <optional>
#include <string>

#include "compare/base/palette.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// The answer, the figures side by side and their differences (in resync the differences at the
// onsets), the split of the judged figures, and for each contact model a verdict with its reasons.
// At most 80 columns wide.
std::string comparison_table(const SceneComparison& comparison, const Palette& palette = Palette());

// Whether and when rotor and ring touch in a run, how hard, and how the rub continues: the rest of
// a sentence that begins with "rubs: ". cut: the time at which the run ended early, s.
std::string rub_answer(const Metrics& metrics, std::optional<double> cut = {});

// The output of `run` for one run: that answer, then the figures.
std::string run_table(const scene::Scene& scene, const Trajectory& trajectory,
                      const Palette& palette = Palette());

}  // namespace rotorub
