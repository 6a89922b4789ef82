// One point of the bench: a setting, its distance from the reference, and its cost.
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

// kChatter: bounces although the reference rubs continuously. kWrongAttractor: settled to another
// attractor. kDiverged: ended early. kRefused: could not run.
enum class Outcome { kOk, kChatter, kWrongAttractor, kDiverged, kRefused };
const char* to_string(Outcome outcome);

// Errors against the reference. Shares are relative to the reference's value; empty if that is 0.
struct PointErrors {
  double position = 0.0;  // m, largest over rows, bodies and contacts
  // Mean |lambda_N - reference| over the rows where the reference is in lasting contact, relative
  // to the reference's mean there; over the rows of all contacts.
  std::optional<double> force;
  std::optional<double> impulse;  // total normal impulse
};
// The trajectory must have the reference's rows.
PointErrors point_errors(const Trajectory& trajectory, const Reference& reference);

// How the run ended compared with the reference; reason: a sentence unless the outcome is kOk.
struct Judgement {
  Outcome outcome = Outcome::kOk;
  std::string reason;
};
// Penetration, in clearances, beyond which the rotor has left the machine and the run has diverged,
// even with a soft contact.
inline constexpr double kLost = 10.0;
// Largest relative difference of whirl frequencies within the same attractor.
inline constexpr double kWhirlTolerance = 0.02;
// contacts: of the run's scene, at least one.
Judgement judge(const Trajectory& trajectory, const Settled& settled, const Settled& reference,
                const std::vector<ContactFacts>& contacts);

// Wall time of the whole integration without output over repeated runs, s.
struct WallTime {
  double median = 0.0, low = 0.0, high = 0.0;
  int repeats = 0;  // 0: not timed
};

struct Point {
  Setting setting;
  Judgement judgement;
  std::optional<PointErrors> errors;  // empty if the run did not reach its end
  std::optional<Metrics> metrics;     // of the recorded run; likewise
  std::optional<double> limit_error;  // m, against the finest step of the same engine and setting
  std::int64_t steps = 0;
  double end = 0.0;            // s, simulated
  double recorded_wall = 0.0;  // s, of the run with output; estimates the time of further runs
  WallTime wall;

  bool finished() const { return errors.has_value(); }
  double us_per_step() const;       // 0 if not timed
  double real_time_factor() const;  // 0 if not timed
};

// Runs each setting of a scene once with output, for its errors. For series of one engine and
// setting it also determines the distance to the finest step (Point::limit_error), which contains
// no error of the contact model.
std::vector<Point> error_pass(const std::vector<Setting>& settings, const Reference& reference,
                              const Progress& progress, const std::atomic<bool>* interrupt);

// Parameters of the timing: repeated whole integrations without output, all points in turns.
struct TimingParameters {
  int repeats = 20;      // >= 1, for each job; fewer if a job would exceed the budget
  int fewest = 5;        // lower limit in that case
  double budget = 20.0;  // s
};

// Number of repeats of a job that takes `seconds`.
int repeats_of(double seconds, const TimingParameters& parameters);

struct TimedJob {
  std::function<double()> run;                // returns its time, s
  double estimate = 0.0;                      // s
  std::function<void(const WallTime&)> keep;  // called at the end
  std::vector<double> seconds{};              // of its runs
};
// Runs every job as often as needed, in turns: job 1, 2, 3, 1, 2, 3, ..., so that a slow phase of
// the computer affects all jobs.
void interleaved(std::vector<TimedJob> jobs, const TimingParameters& parameters,
                 const Progress& progress, const std::atomic<bool>* interrupt);

// Times the points that reached their end.
void timing_pass(std::vector<Point>& points, const TimingParameters& parameters,
                 const Progress& progress, const std::atomic<bool>* interrupt);

// Median, lowest and highest of the values; at least one value.
WallTime wall_time(const std::vector<double>& seconds);

}  // namespace rotorub::bench
