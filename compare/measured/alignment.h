// Where a record lies in time on a simulated run, and how the frame of its sensors stands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/measured/fitting.h"
#include "compare/measured/record.h"
#include "compare/measured/sampled_run.h"

namespace rotorub {

struct AlignmentOptions {
  std::optional<double> shift;  // s, added to the record's times; none: found
  std::optional<double> angle;  // rad, of the sensors' x axis in the scene, from x to y; none:
                                // found where a pair x, y is
};

enum class AngleFrom {
  kGiven,
  kFound,
  kNoPair,  // 0: no x and y of anything is measured
  kCircle   // 0: the motion is a circle, a turn of the frame looks like a shift and leaves as much
};

struct Alignment {
  double shift = 0.0;  // s
  double angle = 0.0;  // rad, in (-pi, pi]
  bool shift_found = true;
  AngleFrom angle_from = AngleFrom::kFound;
  // "rotor", "gap": what it was found by; empty: both are given and nothing moves.
  std::vector<std::string> by;
  std::optional<double> correlation;  // [-1, 1], see fitting.h; none where `by` is empty
  // Share: rms of what is left over the run's deviation, means taken off.
  std::optional<double> residual;
  // Standard deviation if what is left is white noise (the least that any estimate has, Cramer and
  // Rao). The angle's is none where it was not found.
  std::optional<double> shift_error, angle_error;  // s, rad
  std::optional<LagScore> next;                    // the next best shift beyond a valley
  // It leaves less than kTwice what the best leaves, or next to nothing as well: left = sqrt(1 -
  // correlation^2).
  bool ambiguous() const;
  // rad/s: what a shift is made up by of a turn of the frame, in a motion so near to a circle that
  // no more than kNearCircle of the shift's own effect is left by it; none elsewhere, and where one
  // of the two is given.
  std::optional<double> turn_for_shift;
};

inline constexpr double kTwice = 2.0, kNextToNothing = 0.05;
inline constexpr double kLeastCorrelation = 0.5;
// Below it a turn of the frame may do what a shift does: share of the shift's own effect that no
// turn explains. It does where a free angle leaves no less than an angle of 0, but for what noise
// allows.
inline constexpr double kLeastOwnEffect = 0.01, kNearCircle = 0.1;

// By least squares: of all shifts the one of the highest correlation (fitting.h), then between
// the grid's instants the least sum of squares of what is left, each channel by its scale, means
// taken off (a sensor's zero is not known); the angle follows in closed form. Throws MeasuredError
// where record and run do not overlap, or no shift makes them alike.
Alignment align(const MeasuredRecord& record, const SampledRun& run,
                const AlignmentOptions& options);

// The sentence on it, for people: "shift +1.234567 ms, angle 12.3 deg, by rotor ...".
std::string alignment_text(const Alignment& alignment);

}  // namespace rotorub
