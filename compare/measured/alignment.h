// Where a record lies in time on a simulated run, and how the frame of its sensors stands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/measured/lag_search.h"
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
  kCircle   // 0: the motion is a circle to within the noise: a turn of the frame looks like a shift
};

// The record with the y of its sensors turned round, which lies on the run by far better: their
// axes are mirrored, or x and y exchanged (a mirror and a quarter turn), or the machine whirls the
// other way than the run.
struct Mirrored {
  double shift = 0.0;  // s
  double angle = 0.0;  // rad, of the sensors' x axis; y is a quarter turn back from it
  double residual = 0.0;
  std::string flag;  // that says so: "--measured-probes=20deg,-70deg"
};

struct Alignment {
  double shift = 0.0;  // s
  double angle = 0.0;  // rad, in (-pi, pi]
  bool shift_found = true;
  AngleFrom angle_from = AngleFrom::kFound;
  // "rotor", "gap": what it was found by; empty: both are given and nothing moves.
  std::vector<std::string> by;
  std::optional<double> correlation;  // [-1, 1], see lag_search.h; none where `by` is empty
  // Share: rms of what is left over the run's deviation, means taken off.
  std::optional<double> residual;
  std::optional<double> gain;  // rms of the record over the run's; as the residual
  // Standard deviation if what is left is white noise (the least that any estimate has, Cramer and
  // Rao). The angle's is none where it was not found.
  std::optional<double> shift_error, angle_error;  // s, rad
  std::optional<LagScore> next;                    // the next best shift beyond a valley
  // It leaves less than kTwice what the best leaves, or next to nothing as well: left = sqrt(1 -
  // correlation^2), and the same of the likeness.
  bool ambiguous() const;
  // Where it leaves much: a shift at which the two are more alike, but for the size.
  std::optional<LagScore> other_size;
  std::optional<Mirrored> mirrored;  // where that leaves less than half
  // rad/s: what a shift is made up by of a turn of the frame, in a motion so near to a circle that
  // no more than kNearCircle of the shift's own effect is left by it; none elsewhere, and where one
  // of the two is given.
  std::optional<double> turn_for_shift;
};

inline constexpr double kTwice = 2.0, kNextToNothing = 0.05;
// What a shift that was found must have: a correlation, and what is left (rms) no more than this
// times what the run moves, and what the record does. Alike to the last digit and of another size
// by three is another motion, or other units.
inline constexpr double kLeastCorrelation = 0.5, kMostLeft = 2.0;
// A turn of the frame may do what a shift does: share of the shift's own effect that no turn
// explains.
inline constexpr double kNearCircle = 0.1;
// rad: an angle that the data tell, together with the shift, to no better than this is not told.
inline constexpr double kAngleTold = 0.3;

// By least squares: of all shifts the most alike (lag_search.h), then between the grid's instants
// the least sum of squares of what is left, each channel by its scale, means taken off (a sensor's
// zero is not known); the angle follows in closed form. Where the curvature of that sum by shift
// and angle is singular to within the noise (kAngleTold), and an angle of 0 leaves as little, the
// motion is a circle. Throws MeasuredError where record and run do not overlap, or no shift makes
// them alike, and says whether mirrored sensors do.
Alignment align(const MeasuredRecord& record, const SampledRun& run,
                const AlignmentOptions& options);

// The same, taken however bad it is: what a search over runs compares.
Alignment best_alignment(const MeasuredRecord& record, const SampledRun& run,
                         const AlignmentOptions& options);

// The sentence on it, for people: "shift +1.234567 ms, angle 12.3 deg, by rotor ...".
std::string alignment_text(const Alignment& alignment);
std::string mirrored_text(const Mirrored& mirrored);
std::string other_size_text(const LagScore& at);
std::string channels_text(const std::vector<std::string>& by);  // "rotor, ring and gap"

}  // namespace rotorub
