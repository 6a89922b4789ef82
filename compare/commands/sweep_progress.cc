#include "compare/commands/sweep_progress.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

namespace rotorub {
namespace {

constexpr double kMeasured = 1.0;  // s of running points before their time is estimated
// s without an estimate, after which only the number is printed.
constexpr double kEstimatePatience = 2.0;

std::string duration_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string number_of(std::int64_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// "125 points of shard 2/4"
std::string all_text(const sweep::SweepProgress& progress, const sweep::Shard& shard) {
  const std::string points = number_of(progress.of, "point");
  return shard.whole() ? points
                       : fmt::format("{} of shard {}/{}", points, shard.number, shard.count);
}

}  // namespace

std::string plan_text(const sweep::SweepProgress& progress, const sweep::Shard& shard, int jobs,
                      double passed) {
  const std::string all = all_text(progress, shard), with = number_of(jobs, "job");
  const std::int64_t to_run = progress.of - progress.stored + progress.now;
  if (to_run == 0) return fmt::format("nothing is left to run; results of {} are stored", all);
  const bool resumed = to_run < progress.of;
  const std::string points = resumed ? fmt::format("{} of {}", to_run, all) : all;
  if (!progress.left)
    return fmt::format("{} will run with {}; an estimate of the time will follow", points, with);
  const double total = passed + *progress.left;
  return fmt::format("{} will take {} with {}{}", points,
                     total < 1.0 ? "less than 1 s" : "about " + duration_text(total), with,
                     resumed ? "; the others are done" : "");
}

SweepProgressReport::SweepProgressReport(bool quiet, const sweep::Shard& shard, int jobs)
    : quiet_(quiet), shard_(shard), jobs_(jobs), bar_(quiet) {}

void SweepProgressReport::show(const sweep::SweepProgress& progress) {
  if (quiet_) return;
  const double passed = std::chrono::duration<double>(Clock::now() - start_).count();
  const bool measured = progress.left && (passed >= kMeasured || *progress.left == 0.0);
  if (!planned_ && (measured || (!counted_ && passed >= kEstimatePatience))) {
    bar_.clear();
    print_message(plan_text(progress, shard_, jobs_, passed));
    counted_ = true;
    planned_ = measured;
  }
  const double share = progress.of > 0
                           ? static_cast<double>(progress.stored) / static_cast<double>(progress.of)
                           : 1.0;
  bar_.show(share, fmt::format("{} of {} points  {}", progress.stored, progress.of,
                               progress.left ? duration_text(*progress.left) + " left" : ""));
}

}  // namespace rotorub
