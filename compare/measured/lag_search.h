// Possible positions of a record on a run: how well it fits at every shift of an even grid.
#pragma once

#include <optional>
#include <vector>

#include "compare/measured/fitting.h"

namespace rotorub {

// The quality of a shift. With m the record's values and s the run's at the same instants, each
// without its mean over the common samples and divided by the scale of its channel, and with sums
// over samples and channels,
//
//   correlation = Re sum conj(e^{i A} m) s  /  sqrt(sum |m|^2  sum |s|^2)
//   gain        = sqrt(sum |m|^2 / sum |s|^2)
//   likeness    = 1 - sum |e^{i A} m - s|^2 / (sum |m|^2 + sum |s|^2)
//               = 2 gain / (1 + gain^2)  correlation,
//
// A = arg sum conj(m) s over the pairs, or as given. Shifts are compared by their likeness (L. Lin,
// "A concordance correlation coefficient to evaluate reproducibility", Biometrics 45, 1989),
// because with a free angle any circle correlates with any other, whatever their sizes.
struct LagScore {
  double shift = 0.0;        // s, added to the record's times
  double correlation = 0.0;  // [-1, 1]
  double gain = 1.0;         // > 0
  double likeness() const { return 2.0 * gain / (1.0 + gain * gain) * correlation; }
};

// Considers all shifts on an even grid at which record and run have at least kLeastOverlap of the
// shorter one's samples in common, wherever the zeros of their clocks are. best: the greatest
// likeness. next: the best other peak that is separated from it by a valley, with likenesses below
// kValley times the best. Uses Fourier transforms of values with gaps (D. Padfield, "Masked object
// registration in the Fourier domain", IEEE Trans. Image Process. 21, 2012). Throws MeasuredError
// if there is no such shift.
struct BestLags {
  LagScore best;
  std::optional<LagScore> next;
  LagScore most_correlated;  // the greatest correlation, whatever the gain
  // s, interval of the grid: the record's, or larger if the grid would have too many points
  double apart = 0.0;
};
inline constexpr double kLeastOverlap = 0.5, kValley = 0.9;
BestLags best_lags(const MeasuredRecord& record, const SampledRun& run,
                   const std::vector<Channel>& channels, std::optional<double> angle);

}  // namespace rotorub
