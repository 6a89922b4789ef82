// The bench of one scene: reference, points and their evaluation; and the computer that it ran on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"
#include "compare/bench/soft_contact.h"
#include "compare/bench/work_precision.h"

namespace rotorub::bench {

// The computer on which the times were measured.
struct Machine {
  std::string processor;     // name from the kernel
  int threads = 0;           // hardware threads; every run uses one
  std::string instructions;  // the processor's widest vector instructions
  std::string compiler;
  std::string mujoco;  // version
};
Machine this_machine();

struct BenchParameters {
  Ladder ladder = default_ladder();
  TimingParameters timing;
  std::vector<BenchEngine> engines = chosen_engines("");
  bool stability_map = false;  // also make the map, with hundreds of further runs
};

struct SceneBench {
  scene::Scene scene;
  Reference reference;
  std::vector<BenchEngine> engines;
  std::vector<Point> points;
  std::vector<Level> levels;
  std::optional<StabilityMap> stability;
  bool interrupted = false;
  // m, of which the levels of error are shares: the smallest of all contacts.
  double clearance() const { return smallest_clearance(scene).value(); }
  // Errors between the accuracy of the reference and the size of the clearance.
  ErrorRange telling_errors() const { return {kReferenceMargin * reference.error, clearance()}; }
};

// reader: reads the scene with further overrides after the user's. Throws what the reader and
// make_reference throw, and std::invalid_argument for a scene without a contact.
SceneBench bench_scene(const SceneReader& reader, const BenchParameters& parameters,
                       const Progress& progress, const std::atomic<bool>* interrupt);

}  // namespace rotorub::bench
