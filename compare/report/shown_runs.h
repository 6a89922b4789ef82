// What a page shows of one scene: its runs side by side, whoever made them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/measured/measured_run.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// The pointed to must outlive it.
struct ShownRun {
  std::string label;  // "native", "rigid", "coulomb", "cone", "shadow": its colour in the page
  const Trajectory* trajectory = nullptr;
};

struct ShownRuns {
  const scene::Scene* scene = nullptr;
  std::vector<ShownRun> runs;                // the first two are compared first
  const MeasuredRun* measured = nullptr;     // laid beside them; null: none
  const Trajectory* uncontrolled = nullptr;  // the first run with a passive bearing; null: none
};

ShownRuns shown_runs(const SceneComparison& comparison);
// Of a run's folder, with its shadow where it has one.
ShownRuns shown_runs(const StoredRun& run, const std::optional<StoredRun>& shadow);

// s; nothing where it never touches.
std::optional<double> first_touch(const Trajectory& trajectory);

}  // namespace rotorub
