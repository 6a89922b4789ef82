// Every shift that lays a record on a run, on an even grid: correlation by Fourier transforms, of
// values with holes (D. Padfield, "Masked object registration in the Fourier domain", IEEE Trans.
// Image Process. 21, 2012).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compare/measured/channel.h"

namespace rotorub {

// What is known of a shift. With m the record's values, s the run's at the same instants, each less
// its mean over the samples that both have and over the scale of its channel, and sums over samples
// and channels,
//
//   correlation = Re sum conj(e^{i A} m) s  /  sqrt(sum |m|^2  sum |s|^2),
//
// A = arg sum conj(m) s over the pairs, or as given.
struct LagScore {
  double shift = 0.0;        // s, added to the record's times
  double correlation = 0.0;  // [-1, 1]
};

// Ascending in shift, a grid interval apart: those at which record and run have at least
// kLeastOverlap of the shorter one's samples in common, whatever the clock's zero. The interval is
// the record's, more where that would be too many.
inline constexpr double kLeastOverlap = 0.5;
std::vector<LagScore> lag_scores(const MeasuredRecord& record, const SampledRun& run,
                                 std::span<const Channel> channels, std::optional<double> angle);

// The best, and the best other peak that a valley parts from it (correlations below kValley of the
// best).
struct BestLags {
  LagScore best;
  std::optional<LagScore> next;
};
inline constexpr double kValley = 0.9;
BestLags best_lags(std::span<const LagScore> scores);  // scores: one or more

}  // namespace rotorub
