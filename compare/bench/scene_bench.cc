#include "compare/bench/scene_bench.h"

#include <fmt/format.h>

#include <stdexcept>

#include "compare/bench/error_pass.h"

namespace rotorub::bench {

SceneBench bench_scene(const SceneReader& reader, const BenchParameters& parameters,
                       const Progress& progress, const std::atomic<bool>* interrupt) {
  const auto stopped = [&] { return interrupt && interrupt->load(std::memory_order_relaxed); };
  SceneBench bench;
  bench.scene = reader({});
  bench.engines = parameters.engines;
  if (!bench.scene.first().contact) {
    throw std::invalid_argument(fmt::format(
        "{}: the errors of a bench are shares of contact.clearance, and there is no [contact]",
        bench.scene.name));
  }
  // Shares of the time, roughly: nearly all of it goes into the timed repeats.
  const auto part = [&](double from, double to) {
    return [&progress, from, to](double share, const std::string& what) {
      progress(from + (to - from) * share, what);
    };
  };
  RunRequest request;
  request.interrupt = interrupt;
  request.output_times = common_times(bench.scene.run, parameters.ladder.steps);
  bench.reference = make_reference(bench.scene, request);

  std::vector<Setting> settings;
  for (const BenchEngine& engine : parameters.engines) {
    for (Setting& s : engine.settings(reader, parameters.ladder)) settings.push_back(std::move(s));
  }
  bench.points = error_pass(settings, bench.reference, part(0.0, 0.1), interrupt);
  timing_pass(bench.points, parameters.timing, part(0.1, 0.9), interrupt);
  bench.levels = levels(bench.points, bench.engines, bench.scene.first().contact->clearance,
                        bench.reference.error);
  if (parameters.stability_map && !stopped()) {
    bench.stability = stability_map(reader, bench.scene, part(0.9, 1.0), interrupt);
  }
  bench.interrupted = stopped();
  return bench;
}

}  // namespace rotorub::bench
