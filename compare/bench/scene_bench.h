// The bench of one scene: reference, points, and what they say; and the machine that it ran on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"
#include "compare/bench/soft_contact.h"
#include "compare/bench/work_precision.h"

namespace rotorub::bench {

// What times were measured on.
struct Machine {
  std::string processor;     // as the kernel names it
  int threads = 0;           // hardware threads; every run here takes one
  std::string instructions;  // the widest vector instructions of the processor
  std::string compiler;
  std::string mujoco;  // version
};
Machine this_machine();

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
