// One point of the bench: a setting, how far it is from the reference, and what it costs.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/reference.h"
#include "compare/metrics/metrics.h"

namespace rotorub::bench {

// kChatter: bounces where the reference rubs for good; kWrongAttractor: has settled to something
// else; kDiverged: ended early; kRefused: could not be run at all.
enum class Outcome { kOk, kChatter, kWrongAttractor, kDiverged, kRefused };
const char* to_string(Outcome outcome);

// Against the reference. Shares are of the reference's own value; none where it is 0.
struct PointErrors {
  double position = 0.0;        // m, largest over rows and bodies
  std::optional<double> force;  // mean |lambda_N - reference| over the rows where the reference is
                                // in lasting contact, as a share of its mean there
  std::optional<double> impulse;  // total normal impulse
};
// The trajectory must have the reference's rows.
PointErrors point_errors(const Trajectory& trajectory, const Reference& reference);

// How the run ended, against how the reference did; `reason`: a sentence for anything but ok.
struct Judgement {
  Outcome outcome = Outcome::kOk;
  std::string reason;
};
// Clearances that the rotor may be deep in the ring; beyond it has left the machine, and the run
// has diverged, whatever a soft contact says.
inline constexpr double kLost = 10.0;
// Share by which a whirl frequency may differ from that of the same attractor in the reference.
inline constexpr double kWhirlTolerance = 0.02;
Judgement judge(const Trajectory& trajectory, const Settled& settled, const Settled& reference,
                double clearance);

// Wall time of the whole integration over repeated runs with the output off, s.
struct WallTime {
  double median = 0.0, low = 0.0, high = 0.0;
  int repeats = 0;  // 0: not timed
};

struct Point {
  Setting setting;
  Judgement judgement;
  std::optional<PointErrors> errors;  // none: it did not reach the end
  std::optional<Metrics> metrics;     // of the recorded run, likewise
  std::optional<double> limit_error;  // m: from its own finest step
  std::int64_t steps = 0;
  double end = 0.0;            // s, simulated
  double recorded_wall = 0.0;  // s, of the run with its output on: how long others may take
  WallTime wall;

  bool finished() const { return errors.has_value(); }
  double us_per_step() const;       // 0 where it was not timed
  double real_time_factor() const;  // likewise
};

// The pass over the settings of a scene for their errors, with the output on: one run each. Series
// of one engine and setting also get their distance to their own finest step (Point::limit_error),
// which holds no error of the contact model.
std::vector<Point> error_pass(const std::vector<Setting>& settings, const Reference& reference,
                              const Progress& progress, const std::atomic<bool>* interrupt);

// The pass for the times: repeated whole integrations with the output off, all points in turns.
struct TimingParameters {
  int repeats = 20;      // >= 1, of each; fewer of a job that would take longer than the budget
  int fewest = 5;        // but so many of it
  double budget = 20.0;  // s
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
