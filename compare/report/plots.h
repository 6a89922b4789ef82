// The plots and the player of one scene on a page, in the format of the page's scripts. Its runs
// stand side by side and may come from any source.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/measured/measured_run.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// The referenced objects must outlive this.
struct ShownRun {
  // "native", "rigid", "coulomb", "cone", "shadow"; selects its colour in the page.
  std::string label;
  const Trajectory* trajectory = nullptr;
};

struct ShownRuns {
  const scene::Scene* scene = nullptr;
  std::vector<ShownRun> runs;                // the first two are compared initially
  const MeasuredRun* measured = nullptr;     // shown beside them; may be null
  const Trajectory* uncontrolled = nullptr;  // the first run with a passive bearing; may be null
};

ShownRuns shown_runs(const SceneComparison& comparison);
// From a run's folder, including its shadow if there is one.
ShownRuns shown_runs(const StoredRun& run, const std::optional<StoredRun>& shadow);

// For the scripts: runs as tracks (pack/packed_run.h), impacts on their laws, and the
// drawn rig.
nlohmann::json plot_data(const ShownRuns& shown);

}  // namespace rotorub
