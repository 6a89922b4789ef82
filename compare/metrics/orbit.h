// Figures of the rotor's orbit: the full spectrum of rotor dynamics, with forward and backward
// whirl separated (D. E. Bently, C. T. Hatch, "Fundamentals of Rotating Machinery Diagnostics",
// 2002, chapter 8; computed with FFTW), and its position once per turn.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// For z = x + i y sampled every h seconds, without its mean under a Hann window w:
//
//   a(f) = |sum_n w_n z_n exp(-2 pi i f n h)| / sum_n w_n,   f = k / (N h), -1 <= 2 f h < 1.
//
// A circular orbit of radius R gives R at its whirl frequency, which is negative for backward
// whirl; between two frequencies of the grid at least 0.84 R.
struct FullSpectrum {
  std::vector<double> frequency;  // Hz, ascending, both signs
  std::vector<double> amplitude;  // unit of z: m
};
// z: at least two values; h > 0. finer >= 1: zeros are appended to z to get that many times as many
// frequencies. The peak between two frequencies is then underestimated less: by up to 16 % for 1,
// by 0.02 % for 32.
FullSpectrum full_spectrum(std::span<const std::complex<double>> z, double h,
                           std::size_t finer = 1);

// Spectra of stretches of z that overlap by three quarters.
struct Waterfall {
  std::vector<double> time;       // s from the first value, of the middle of each stretch
  std::vector<double> frequency;  // as in one spectrum
  std::vector<double> amplitude;  // one row per time
};
// stretch: number of values in each, 4 <= stretch <= number of values.
Waterfall waterfall(std::span<const std::complex<double>> z, double h, std::size_t stretch);

// The rotor at the contact, x + i y in m, at `count` >= 2 even times from `from` to `to` (both
// included) within the run, cubic between rows using its velocities.
std::vector<std::complex<double>> even_orbit(const Trajectory& run, double from, double to,
                                             std::size_t count);

// The rotor's positions once per turn of its spin (Poincare section at the keyphasor): one point
// for a synchronous motion, k points for one that repeats after k turns, a closed curve for two
// frequencies, a cloud for chaos. x + i y at the contact, m, for the passes from `from` (s) on;
// empty for a rotor at rest.
std::vector<std::complex<double>> poincare_points(const Trajectory& run, double from);

// The number of turns after which such positions repeat, all within `tolerance` of the largest
// distance from 0: 1 for a synchronous motion. 0 if they do not repeat up to kMostPeriod, or if
// there are fewer than twice as many positions plus two.
inline constexpr int kMostPeriod = 16;
int section_period(const std::vector<std::complex<double>>& places, double tolerance = 1e-3);

}  // namespace rotorub
