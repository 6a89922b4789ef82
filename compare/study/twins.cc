#include "compare/study/twins.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

namespace rotorub {

int twin_ulps(int index) { return (index % 2 == 0 ? 1 : -1) * (index / 2 + 1); }

Twins run_twins(const Engine& engine, const scene::Scene& scene, const Trajectory& original,
                double threshold, const TwinParameters& parameters) {
  const auto count = static_cast<std::size_t>(parameters.count);
  Twins twins{std::vector<Metrics>(count), std::vector<Divergence>(count)};
  const auto stopped = [&] { return parameters.interrupt && parameters.interrupt->load(); };

  // Each twin writes to its own place.
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

  // A twin that throws ends them all.
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t k = next++; k < count && !stopped(); k = next++) {
        run(k);
        const std::lock_guard lock(mutex);
        ++done;
        if (parameters.progress) {
          parameters.progress(static_cast<double>(done) / static_cast<double>(count));
        }
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others;
  const std::size_t threads = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 16);
  for (std::size_t k = 1; k < std::min(threads, count); ++k) others.emplace_back(work);
  work();
  for (std::thread& thread : others) thread.join();
  if (failure) std::rethrow_exception(failure);
  if (stopped()) return {};
  return twins;
}

}  // namespace rotorub
