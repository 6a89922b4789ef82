// A figure among runs whose starts differ only by round-off: how accurately it is known.
#pragma once

#include <span>
#include <vector>

#include "compare/figures/figure.h"

namespace rotorub {

struct FigureSample {
  double value = 0.0;      // SI, of the run that is shown
  double mean = 0.0;       // of the run and its twins
  double deviation = 0.0;  // standard deviation of one run; 0 without twins
  int count = 1;           // runs
  // Shares on the figure's scale: the largest |deviation| of a twin, and the smallest difference
  // that a replay can resolve (replay_floor() in study), 0 except there.
  double floor = 0.0, replay_floor = 0.0;
};

FigureSample figure_sample(const Figure& figure, const Metrics& run,
                           std::span<const Metrics> twins);
// One for each figure, in the order of figures().
std::vector<FigureSample> figure_samples(const Metrics& run, std::span<const Metrics> twins);

// half: half of the 95 % confidence interval of the difference of the means. least_detectable: the
// smallest difference that 4 of 5 such comparisons would detect (80 % power). SI (Welch, Biometrika
// 34, 1947). A side with one run is assumed to scatter like the other side.
struct Interval {
  double half = 0.0, least_detectable = 0.0;
};
Interval interval(const FigureSample& a, const FigureSample& b);

// For each figure, half of the interval of one run against a group, on the figure's scale.
std::vector<double> single_run_intervals(const std::vector<FigureSample>& groups);

}  // namespace rotorub
