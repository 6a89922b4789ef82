// The bench of one scene: reference, points, and what they say.
#pragma once

#include <optional>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/levels.h"
#include "compare/bench/point.h"
#include "compare/bench/series.h"
#include "compare/bench/stability_map.h"
#include "compare/bench/timing_pass.h"

namespace rotorub::bench {

struct BenchParameters {
  Ladder ladder = default_ladder();
  TimingParameters timing;
  std::vector<BenchEngine> engines = chosen_engines("");
  bool stability_map = false;  // too: hundreds of runs more
};

struct SceneBench {
  scene::Scene scene;
  Reference reference;
  std::vector<BenchEngine> engines;
  std::vector<Point> points;
  std::vector<Level> levels;
  std::optional<StabilityMap> stability;
  bool interrupted = false;
  // What the reference cannot tell, and errors of the size of the clearance.
  ErrorRange telling_errors() const {
    return {kReferenceMargin * reference.error, scene.first().contact->clearance};
  }
};

// `reader` gives the scene with overrides beyond those of the user. Throws what the reader and
// make_reference throw, and std::invalid_argument for a scene without a contact.
SceneBench bench_scene(const SceneReader& reader, const BenchParameters& parameters,
                       const Progress& progress, const std::atomic<bool>* interrupt);

}  // namespace rotorub::bench
