// Runs whose starts are a few units in the last place apart: how well the motion repeats itself,
// which no comparison can be better than.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "compare/base/in_parallel.h"
#include "compare/engine/engine.h"
#include "compare/figures/figure_sample.h"
#include "compare/metrics/divergence.h"
#include "compare/metrics/metrics.h"

namespace rotorub {

struct Twins {
  std::vector<Metrics> metrics;  // one a twin, in the order of the starts
  // Of each from the run whose twins they are, where that has rows; in the same order.
  std::vector<Divergence> divergences;
};

struct TwinParameters {
  int count = 20;  // >= 0, at most; starts +1, -1, +2, -2, ... ulps away
  // Asked before every kTwinBatch of them: whether no more are needed. Empty: all are run.
  std::function<bool(const Twins&)> enough;
  Jobs jobs = 0;
  std::optional<double> step;        // s; none: the scene's
  std::vector<double> output_times;  // s, rows: of `divergence`, and of what figures need rows
  std::shared_ptr<const CommandRecord> commands;  // that drive them all; null: none
  std::function<void(double)> progress;
  const std::atomic<bool>* interrupt = nullptr;
};

inline constexpr int kTwinBatch = 4;

// +1, -1, +2, -2, ...
int twin_ulps(int index);

// They run in several threads: of MuJoCo while a MujocoInPlace lives. The result does not depend on
// the number of jobs. An interrupt leaves both lists empty. `threshold`: m, beyond which two runs
// have parted.
Twins run_twins(const Engine& engine, const scene::Scene& scene, const Trajectory& original,
                double threshold, const TwinParameters& parameters);

// Of each figure among a run and its twins.
struct Repeatability {
  std::vector<FigureSample> samples;  // as figures()
  std::vector<double> floor;          // largest |deviation| of a twin
  std::vector<double> replay_floor;   // see replay_floor(); 0 but in replay
};
Repeatability repeatability(const Metrics& run, const Twins& twins);

// That of the twin that parts first; of those that never part the one that comes furthest. `none`:
// without twins.
Divergence first_to_part(const Twins& twins, Divergence none);

}  // namespace rotorub
