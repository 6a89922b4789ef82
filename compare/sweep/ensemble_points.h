// Points of the fixed step `verlet`, many at once in the vector registers of a core
// (native_model/stepping/ensemble.h). A point's figures do not depend on which points it is run
// with.
#pragma once

#include <atomic>
#include <vector>

#include "compare/sweep/point_result.h"
#include "native_model/scene/scene.h"

namespace rotorub::sweep {

struct PointScene {
  std::int64_t point = 0;
  scene::Scene scene;
};

bool has_ensemble(scene::Integrator integrator);

// The results in no order; those of an interrupt are missing. Points whose structures differ (other
// parts, another step or end) come in ensembles of their own; one of several contacts is run alone.
// One that fails is run again alone, so that its row says when and why.
std::vector<PointResult> run_ensembles(const std::vector<PointScene>& points,
                                       const std::atomic<bool>& interrupt);

}  // namespace rotorub::sweep
