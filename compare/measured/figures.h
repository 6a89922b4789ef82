// The figures of a measured run, from columns of values at the same samples.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "compare/measured/measured_run.h"

namespace rotorub {

// A record's column on the run, and the same of each run: values at the same samples.
struct HeldColumn : MeasuredColumn {
  std::vector<std::vector<double>> runs;  // SI, each as `value`
};

// What every figure needs of the scene and the record.
struct FigureFacts {
  std::vector<double> t;            // s, of the samples; ascending
  double interval = 0.0;            // s
  std::optional<double> clearance;  // m; none: no contact
  bool rate_tells = true;           // frequencies: the sample rate is high enough for them
};

// Those that the columns support. A frequency needs kLeastTurns in the record.
std::vector<MeasuredFigure> figures_of(const std::vector<HeldColumn>& columns,
                                       const FigureFacts& facts);
// A run's own frequency beyond this share of the sample rate is not to be seen in the record.
inline constexpr double kMostOfRate = 0.4;
// A gap below this share of the clearance counts as contact, of record and runs alike: no sensor's
// zero is exact.
inline constexpr double kTouchShare = 0.01;

// The frequency (Hz, backward whirl negative) that x + i y is largest at, and its amplitude, of z
// at even times h s apart: the peak of full_spectrum() by a parabola through its logarithm. None
// below kLeastTurns in all.
inline constexpr double kLeastTurns = 3.0;
struct DominantWhirl {
  double frequency = 0.0, amplitude = 0.0;
};
std::optional<DominantWhirl> dominant_whirl(const std::vector<std::complex<double>>& z, double h);

}  // namespace rotorub
