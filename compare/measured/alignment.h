// The alignment of a record with a simulated run: in time, and of the sensors' frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/measured/lag_search.h"
#include "compare/measured/record.h"
#include "compare/measured/sampled_run.h"

namespace rotorub {

struct AlignmentOptions {
  std::optional<double> shift;  // s, added to the record's times; empty: searched for
  // rad, of the sensors' x axis in the scene, from x to y; empty: searched for if there is a pair
  // x, y
  std::optional<double> angle;
};

enum class AngleFrom {
  kGiven,
  kFound,
  kNoPair,  // the angle is 0, because no pair x, y is measured
  // The angle is 0, because the motion is circular to within the noise, so a turn of the frame is
  // indistinguishable from a shift.
  kCircle
};

// The alignment with the sensors' y axis reversed, if it fits the run much better. Then the sensor
// axes are mirrored, or x and y are exchanged (a mirror and a quarter turn), or the machine whirls
// in the opposite direction of the run.
struct Mirrored {
  double shift = 0.0;  // s
  double angle = 0.0;  // rad, of the sensors' x axis; their y axis is a quarter turn behind it
  double residual = 0.0;
  std::string flag;  // the option for it: "--measured-probes=20deg,-70deg"
};

struct Alignment {
  double shift = 0.0;  // s
  double angle = 0.0;  // rad, in (-pi, pi]
  bool shift_found = true;
  AngleFrom angle_from = AngleFrom::kFound;
  // The signals by which it was found, such as "rotor" or "gap"; empty if both are given and
  // nothing moves.
  std::vector<std::string> by;
  std::optional<double> correlation;  // [-1, 1], see lag_search.h; empty if `by` is empty
  // Rms of the remaining difference relative to the run's deviation, both without their means.
  std::optional<double> residual;
  std::optional<double> gain;  // rms of the record relative to the run's; empty if `residual` is
  // Standard deviations if the remaining difference is white noise (the Cramer-Rao bound).
  // angle_error is empty if the angle was not searched for.
  std::optional<double> shift_error, angle_error;  // s, rad
  std::optional<LagScore> next;                    // the second-best shift, separated by a valley
  // Whether the second-best shift leaves less than kTwice times the difference of the best one, or
  // also next to nothing, with the difference taken as sqrt(1 - correlation^2), and likewise with
  // the likeness.
  bool ambiguous() const;
  // A shift at which the two are more alike except for their size; only if much remains.
  std::optional<LagScore> other_size;
  std::optional<Mirrored> mirrored;  // if it leaves less than half
  // rad/s: the turn of the frame per shift that compensates a shift. Set if the motion is so nearly
  // circular that at most the share kNearCircle of the shift's effect remains; otherwise empty,
  // also if shift or angle is given.
  std::optional<double> turn_for_shift;
};

inline constexpr double kTwice = 2.0, kNextToNothing = 0.05;
// Requirements for a shift that was searched for: this correlation, and an rms of the remaining
// difference that is at most kMostLeft times the rms of the run and of the record. A record of the
// same shape but three times the size is another motion, or in other units.
inline constexpr double kLeastCorrelation = 0.5, kMostLeft = 2.0;
// The largest share of the effect of a shift that a turn of the frame leaves in a nearly circular
// motion.
inline constexpr double kNearCircle = 0.1;
// rad: if angle and shift together determine the angle no better than this, the angle is unknown.
inline constexpr double kAngleTold = 0.3;

// Least squares: first the shift with the greatest likeness on the grid (lag_search.h), then
// between its instants the shift with the least sum of squares of the difference. Each channel is
// divided by its scale and has its mean removed, because a sensor's zero is unknown; the angle
// follows in closed form. If the curvature of that sum over shift and angle is singular to within
// the noise (kAngleTold) and an angle of 0 fits as well, the motion counts as a circle. Throws
// MeasuredError if record and run do not overlap or no shift makes them alike; the message says
// whether mirrored sensors would.
Alignment align(const MeasuredRecord& record, const SampledRun& run,
                const AlignmentOptions& options);

// The same without refusing a bad fit, for searches over runs.
Alignment best_alignment(const MeasuredRecord& record, const SampledRun& run,
                         const AlignmentOptions& options);

// The alignment as a sentence: "shift +1.234567 ms, angle 12.3 deg, by rotor ...".
std::string alignment_text(const Alignment& alignment);

}  // namespace rotorub
