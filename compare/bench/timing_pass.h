// The pass for the times: repeated whole integrations with the output off, all points in turns.
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "compare/bench/point.h"
#include "compare/bench/progress.h"

namespace rotorub::bench {

struct TimingParameters {
  int repeats = 20;  // >= 1, of each
  // s: a job whose repeats take longer than this in all is repeated less often, but
  int fewest = 5;
  double budget = 20.0;
};

// Repeats of a job that takes `seconds`.
int repeats_of(double seconds, const TimingParameters& parameters);

// Calls every job (it gives its own time, s) as often as it is due, in turns: job 1, 2, 3, 1, 2, 3,
// ..., so that what slows the machine for a while slows all of them. `estimates`: s, one a job.
std::vector<WallTime> interleaved(const std::vector<std::function<double()>>& jobs,
                                  const std::vector<double>& estimates,
                                  const TimingParameters& parameters, const Progress& progress,
                                  const std::atomic<bool>* interrupt);

// Times the points that reached the end.
void timing_pass(std::vector<Point>& points, const TimingParameters& parameters,
                 const Progress& progress, const std::atomic<bool>* interrupt);

// Of values that are not empty: median, lowest, highest.
WallTime wall_time(std::vector<double> seconds);

}  // namespace rotorub::bench
