#include "compare/bench/timing_pass.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rotorub::bench {

int repeats_of(double seconds, const TimingParameters& parameters) {
  const double fit = parameters.budget / std::max(seconds, 1e-12);
  if (fit >= parameters.repeats) return parameters.repeats;
  return std::min(parameters.repeats, std::max(parameters.fewest, static_cast<int>(fit)));
}

WallTime wall_time(std::vector<double> seconds) {
  assert(!seconds.empty());
  std::sort(seconds.begin(), seconds.end());
  const std::size_t n = seconds.size();
  const double median = n % 2 == 1 ? seconds[n / 2] : 0.5 * (seconds[n / 2 - 1] + seconds[n / 2]);
  return {median, seconds.front(), seconds.back(), static_cast<int>(n)};
}

std::vector<WallTime> interleaved(const std::vector<std::function<double()>>& jobs,
                                  const std::vector<double>& estimates,
                                  const TimingParameters& parameters, const Progress& progress,
                                  const std::atomic<bool>* interrupt) {
  std::vector<std::vector<double>> seconds(jobs.size());
  double whole = 1e-12, done = 0.0;
  for (const double t : estimates) whole += t * repeats_of(t, parameters);
  const auto stopped = [&] { return interrupt && interrupt->load(std::memory_order_relaxed); };
  for (int round = 0; round < parameters.repeats; ++round) {
    for (std::size_t k = 0; k < jobs.size() && !stopped(); ++k) {
      if (round >= repeats_of(estimates[k], parameters)) continue;
      const double taken = jobs[k]();
      if (stopped()) break;  // an interrupted run is no time
      seconds[k].push_back(taken);
      done += estimates[k];
      progress(std::min(1.0, done / whole), "times");
    }
  }
  std::vector<WallTime> times;
  for (const auto& all : seconds) times.push_back(all.empty() ? WallTime{} : wall_time(all));
  return times;
}

void timing_pass(std::vector<Point>& points, const TimingParameters& parameters,
                 const Progress& progress, const std::atomic<bool>* interrupt) {
  std::vector<std::function<double()>> jobs;
  std::vector<double> estimates;
  std::vector<Point*> timed;
  for (Point& point : points) {
    if (!point.finished()) continue;
    RunRequest request;
    request.step = point.setting.step;
    request.output_times = std::vector<double>{};
    request.interrupt = interrupt;
    jobs.push_back([setting = point.setting, request] {
      return setting.runner->run(*setting.scene, request).wall_s;
    });
    estimates.push_back(point.recorded_wall);
    timed.push_back(&point);
  }
  const auto times = interleaved(jobs, estimates, parameters, progress, interrupt);
  for (std::size_t k = 0; k < timed.size(); ++k) timed[k]->wall = times[k];
}

}  // namespace rotorub::bench
