// One point of the bench: a setting, how far it is from the reference, and what it costs.
#pragma once

#include <optional>
#include <string>

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
  std::optional<double> limit_error;  // m: from its own finest step (limit.h)
  std::int64_t steps = 0;
  double end = 0.0;            // s, simulated
  double recorded_wall = 0.0;  // s, of the run with its output on: how long others may take
  WallTime wall;

  bool finished() const { return errors.has_value(); }
  double us_per_step() const;       // 0 where it was not timed
  double real_time_factor() const;  // likewise
};

}  // namespace rotorub::bench
