// The figures of a measured run, from columns of values at equal samples.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "compare/measured/measured_run.h"

namespace rotorub {

// A column of the record on the run, and the same of each run, at equal samples.
struct HeldColumn : MeasuredColumn {
  std::vector<std::vector<double>> runs;  // SI, each as `value`
};

// The facts about scene and record that the figures need.
struct FigureFacts {
  std::vector<double> t;            // s, times of the samples, ascending
  double interval = 0.0;            // s
  std::optional<double> clearance;  // m; empty without a contact
  bool rate_tells = true;           // whether the sample rate is high enough for frequencies
};

// The figures that the columns support. A frequency needs kLeastTurns turns in the record.
std::vector<MeasuredFigure> figures_of(const std::vector<HeldColumn>& columns,
                                       const FigureFacts& facts);
// Frequencies of a run above this share of the sample rate are not visible in the record.
inline constexpr double kMostOfRate = 0.4;
// A gap below this share of the clearance counts as contact in record and runs alike, because no
// sensor's zero is exact.
inline constexpr double kTouchShare = 0.01;

// The frequency of the largest component of z = x + i y (Hz, negative for backward whirl) and its
// amplitude. z is sampled at even intervals of h s. The peak of full_spectrum() is interpolated by
// a parabola through its logarithm. Empty if there are fewer than kLeastTurns turns in total.
inline constexpr double kLeastTurns = 3.0;
struct DominantWhirl {
  double frequency = 0.0, amplitude = 0.0;
};
std::optional<DominantWhirl> dominant_whirl(const std::vector<std::complex<double>>& z, double h);

}  // namespace rotorub
