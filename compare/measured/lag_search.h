// Where on a run a record may lie: how well it does at every shift of an even grid.
#pragma once

#include <optional>
#include <vector>

#include "compare/measured/fitting.h"

namespace rotorub {

// What is known of a shift. With m the record's values, s the run's at the same instants, each less
// its mean over the samples that both have and over the scale of its channel, and sums over samples
// and channels,
//
//   correlation = Re sum conj(e^{i A} m) s  /  sqrt(sum |m|^2  sum |s|^2)
//   gain        = sqrt(sum |m|^2 / sum |s|^2)
//   likeness    = 1 - sum |e^{i A} m - s|^2 / (sum |m|^2 + sum |s|^2)
//               = 2 gain / (1 + gain^2)  correlation,
//
// A = arg sum conj(m) s over the pairs, or as given. The likeness (L. Lin, "A concordance
// correlation coefficient to evaluate reproducibility", Biometrics 45, 1989) is what shifts are
// compared by: with an angle of its own any circle correlates with any other, however large.
struct LagScore {
  double shift = 0.0;        // s, added to the record's times
  double correlation = 0.0;  // [-1, 1]
  double gain = 1.0;         // > 0
  double likeness() const { return 2.0 * gain / (1.0 + gain * gain) * correlation; }
};

// Of all shifts on an even grid at which record and run have at least kLeastOverlap of the shorter
// one's samples in common, whatever the clock's zero: the most alike, and the best other peak that
// a valley parts from it (likenesses below kValley of the best). By Fourier transforms, of values
// with holes (D. Padfield, "Masked object registration in the Fourier domain", IEEE Trans. Image
// Process. 21, 2012). Throws MeasuredError where there is no such shift.
struct BestLags {
  LagScore best;
  std::optional<LagScore> next;
  LagScore most_correlated;  // of all shifts, whatever the gain
  double apart = 0.0;  // s, of the grid: the record's interval, more where that would be too many
};
inline constexpr double kLeastOverlap = 0.5, kValley = 0.9;
BestLags best_lags(const MeasuredRecord& record, const SampledRun& run,
                   const std::vector<Channel>& channels, std::optional<double> angle);

}  // namespace rotorub
