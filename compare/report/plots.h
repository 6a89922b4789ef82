// What a page shows of one scene: its runs side by side, whoever made them; their plots and player
// as the page's scripts read them.
#pragma once

#include <nlohmann/json_fwd.hpp>
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

// For the scripts: windows, runs as tracks (pack/packed_run.h), impacts on their laws, the drawn
// rig.
nlohmann::json plot_data(const ShownRuns& shown);
// For the templates player.html and plots.html: {{plots}}, {{windows}}, {{legend}} of every run
// that is drawn, {{contacts}}, and {{several}} of these.
nlohmann::json live_values(const ShownRuns& shown);

}  // namespace rotorub
