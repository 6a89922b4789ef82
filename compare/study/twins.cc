#include "compare/study/twins.h"

#include <algorithm>

namespace rotorub {

int twin_ulps(int index) { return (index % 2 == 0 ? 1 : -1) * (index / 2 + 1); }

Twins run_twins(const Engine& engine, const scene::Scene& scene, const Trajectory& original,
                double threshold, const TwinParameters& parameters) {
  const auto most = static_cast<std::size_t>(parameters.count);
  Twins twins;

  // Each twin writes to its own entry.
  const auto run = [&](std::size_t k) {
    RunRequest request;
    request.step = parameters.step;
    request.output_times = parameters.output_times;
    request.perturbation_ulps = twin_ulps(static_cast<int>(k));
    request.commands = parameters.commands;
    request.interrupt = parameters.interrupt;
    const Trajectory t = engine.run(scene, request);
    twins.metrics[k] = metrics(t, contact_facts(scene));
    twins.divergences[k] = divergence(original, t, threshold);
  };

  const auto tell = [&](double count) {
    if (parameters.progress)
      parameters.progress(count / std::max(1.0, static_cast<double>(parameters.count)));
  };
  std::size_t first = 0;
  while (first < most && !(parameters.enough && parameters.enough(twins))) {
    const std::size_t count =
        parameters.enough ? std::min<std::size_t>(kTwinBatch, most - first) : most - first;
    twins.metrics.resize(first + count);
    twins.divergences.resize(first + count);
    in_parallel(
        count, parameters.jobs, parameters.interrupt,
        [&](double share) {
          tell(static_cast<double>(first) + share * static_cast<double>(count));
        },
        [&](std::size_t k) { run(first + k); });
    if (parameters.interrupt && parameters.interrupt->load()) return {};
    first += count;
  }
  tell(parameters.count);
  return twins;
}

Divergence first_to_part(const Twins& twins, Divergence none) {
  Divergence first = none;
  for (const Divergence& d : twins.divergences) {
    if (d.time && (!first.time || *d.time < *first.time)) first = d;
    if (!first.time && d.max_distance >= first.max_distance) first = d;
  }
  return first;
}

}  // namespace rotorub
