// The native side of every comparison, by the step: `event` has none of its own, but forces are
// averaged over the step that they are compared at.
#pragma once

#include <atomic>
#include <map>
#include <utility>
#include <vector>

#include "compare/figures/figure_sample.h"
#include "compare/metrics/metrics.h"
#include "native_model/scene/scene.h"

namespace rotorub::tune {

struct Reference {
  Metrics metrics;
  std::vector<FigureSample> samples;  // of it and its twins, as figures()
};

// Runs what is asked for once. Throws std::runtime_error where `event` cannot run the scene to its
// end.
class References {
 public:
  References(const scene::Scene& scene, int twins, const std::atomic<bool>* interrupt)
      : scene_(scene), twins_(twins), interrupt_(interrupt) {}
  // window_step: see Runner. Of an interrupted run: what there is.
  const Reference& at(double step, double window_step);

 private:
  const scene::Scene& scene_;
  int twins_;
  const std::atomic<bool>* interrupt_;
  std::map<std::pair<double, double>, Reference> known_;  // by step and window_step
};

}  // namespace rotorub::tune
