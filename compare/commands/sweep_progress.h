// What `rotorub sweep` says on standard error while it runs its points.
#pragma once

#include <chrono>
#include <string>

#include "compare/commands/terminal.h"
#include "compare/sweep/shard.h"
#include "compare/sweep/sweep_run.h"

namespace rotorub {

// "500 points take about 40 s with 2 jobs". `passed`: s since the first point began; the time that
// is told is that and progress.left.
std::string plan_text(const sweep::SweepProgress& progress, const sweep::Shard& shard, int jobs,
                      double passed);

// First a line with the number of points and the time that they take, also where standard error is
// not a terminal; then the bar. The time is estimated from the points that are done after a second,
// or from the first of them if they take longer. `quiet`: nothing is said.
class SweepProgressReport {
 public:
  SweepProgressReport(bool quiet, const sweep::Shard& shard, int jobs);

  void show(const sweep::SweepProgress& progress);
  // Wipes the bar away, so that other text can follow.
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
