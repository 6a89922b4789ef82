// Runs whose starts differ by a few units in the last place. They show how well the motion repeats
// itself, which limits the accuracy of any comparison.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "compare/base/in_parallel.h"
#include "compare/engine/engine.h"
#include "compare/metrics/divergence.h"
#include "compare/metrics/metrics.h"

namespace rotorub {

struct Twins {
  std::vector<Metrics> metrics;  // one per twin, in the order of the starts
  // From the original run to each twin, if that run has rows; in the same order.
  std::vector<Divergence> divergences;
};

struct TwinParameters {
  int count = 20;  // >= 0, upper limit; the starts are +1, -1, +2, -2, ... ulps away
  // Called before each batch of kTwinBatch: whether the twins so far are enough. Empty: all run.
  std::function<bool(const Twins&)> enough;
  Jobs jobs = 0;
  std::optional<double> step;  // s; empty: the scene's
  // s, of the rows for the divergence and for figures that need rows
  std::vector<double> output_times;
  std::shared_ptr<const CommandRecord> commands;  // that drive all twins; null: none
  std::function<void(double)> progress;
  const std::atomic<bool>* interrupt = nullptr;
};

inline constexpr int kTwinBatch = 4;

// +1, -1, +2, -2, ...
int twin_ulps(int index);

// The twins run in several threads; MuJoCo's require that a MujocoInPlace exists. The result does
// not depend on the number of jobs. An interrupt leaves both lists empty. threshold: m; two runs
// have parted when they are further apart.
Twins run_twins(const Engine& engine, const scene::Scene& scene, const Trajectory& original,
                double threshold, const TwinParameters& parameters);

// The divergence of the twin that parts first; if none parts, of the one that gets furthest away.
// none: the result without twins.
Divergence first_to_part(const Twins& twins, Divergence none);

}  // namespace rotorub
