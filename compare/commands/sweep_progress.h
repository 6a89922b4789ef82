// The messages of `rotorub sweep` on standard error while it runs its points.
#pragma once

#include <chrono>
#include <string>

#include "compare/commands/terminal.h"
#include "compare/sweep/shard.h"
#include "compare/sweep/sweep_run.h"

namespace rotorub {

// "500 points take about 40 s with 2 jobs". passed: s since the first point began; the time in the
// text is the sum of it and progress.left.
std::string plan_text(const sweep::SweepProgress& progress, const sweep::Shard& shard, int jobs,
                      double passed);

// First prints a line with the number of points and their total time, even if standard error is not
// a terminal; then shows the bar. The time is estimated from the points done after one second, or
// from the first points if they take longer. quiet: print nothing.
class SweepProgressReport {
 public:
  SweepProgressReport(bool quiet, const sweep::Shard& shard, int jobs);

  void show(const sweep::SweepProgress& progress);
  // Erases the bar, so that other text can follow.
  void clear() { bar_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;

  bool quiet_;
  sweep::Shard shard_;
  int jobs_;
  bool counted_ = false, planned_ = false;  // which lines have been printed
  Clock::time_point start_ = Clock::now();
  ProgressBar bar_;
};

}  // namespace rotorub
