// The frequency that a motion is largest at.
#pragma once

#include <complex>
#include <optional>
#include <vector>

namespace rotorub {

inline constexpr double kLeastTurns = 3.0;  // in all, that tell a frequency

// The frequency (Hz, backward whirl negative) that x + i y is largest at, and its amplitude, of z at even times h s
// apart: the peak of full_spectrum() by a parabola through its logarithm. None below kLeastTurns in all.
struct DominantWhirl {
  double frequency = 0.0, amplitude = 0.0;
};
std::optional<DominantWhirl> dominant_whirl(const std::vector<std::complex<double>>& z, double h);

}  // namespace rotorub
