// A figure among runs that differ by nothing but round-off of their start: how well it is known.
#pragma once

#include <span>
#include <vector>

#include "compare/figures/figure.h"

namespace rotorub {

struct FigureSample {
  double value = 0.0;      // SI, of the run that is shown
  double mean = 0.0;       // of that and its twins
  double deviation = 0.0;  // standard deviation, of one run; 0 without twins
  int count = 1;           // runs
};

FigureSample figure_sample(const Figure& figure, const Metrics& run,
                           std::span<const Metrics> twins);

// Half of the 95 % confidence interval of the difference of the means, and the least difference
// that would be distinguished from none in 4 of 5 such comparisons (the power is 80 %), SI (Welch,
// Biometrika 34, 1947). A side of one run is taken to scatter as the other does.
struct Interval {
  double half = 0.0, least_told = 0.0;
};
Interval interval(const FigureSample& a, const FigureSample& b);

// Of each figure half of the interval of one run against a group, on the figure's scale.
std::vector<double> single_run_intervals(const std::vector<FigureSample>& groups);

}  // namespace rotorub
