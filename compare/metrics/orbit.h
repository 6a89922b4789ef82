// Figures of the rotor's orbit: whirl over frequency, forward and backward apart, which rotor
// dynamics calls the full spectrum (D. E. Bently, C. T. Hatch, "Fundamentals of Rotating Machinery
// Diagnostics", 2002, chapter 8; by FFTW), and its places once a turn.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Of z = x + i y, taken every h seconds, its mean removed, under a Hann window w,
//
//   a(f) = |sum_n w_n z_n exp(-2 pi i f n h)| / sum_n w_n,   f = k / (N h), -1 <= 2 f h < 1.
//
// A circular orbit of radius R gives R at the frequency that it whirls with, backward ones below 0;
// between two frequencies of the grid no less than 0.84 R.
struct FullSpectrum {
  std::vector<double> frequency;  // Hz, ascending, both signs
  std::vector<double> amplitude;  // as z: m
};
// z: two values or more; h > 0. finer >= 1: zeros are added behind z to give so many times as many
// frequencies, so that a peak between two of them is underestimated less: by 16 % at 1, by 0.02 %
// at 32.
FullSpectrum full_spectrum(std::span<const std::complex<double>> z, double h,
                           std::size_t finer = 1);

// Spectra of stretches of z that overlap by three quarters.
struct Waterfall {
  std::vector<double> time;       // s from the first value, of each stretch's middle
  std::vector<double> frequency;  // as of one spectrum
  std::vector<double> amplitude;  // a row for each time
};
// stretch: of how many values, 4 <= stretch <= the number of values.
Waterfall waterfall(std::span<const std::complex<double>> z, double h, std::size_t stretch);

// The rotor at the contact, x + i y in m, at `count` even times from `from` to `to` (both included)
// within the run: cubic between rows, by its velocities. count >= 2.
std::vector<std::complex<double>> even_orbit(const Trajectory& run, double from, double to,
                                             std::size_t count);

// The rotor's places once a turn of its spin: a point for a synchronous motion, k points for one
// that repeats after k turns, a closed curve for two frequencies, a cloud for chaos (Poincare
// section at the keyphasor). x + i y of it at the contact, m, of the passes from `from` (s) on;
// empty for a rotor at rest.
std::vector<std::complex<double>> poincare_points(const Trajectory& run, double from);

// After how many turns such places come back to themselves, all of them within `tolerance` of the
// largest distance from 0: 1 of a synchronous motion; 0: after none up to kMostPeriod, or too few
// places to tell, fewer than twice as many and two.
inline constexpr int kMostPeriod = 16;
int section_period(const std::vector<std::complex<double>>& places, double tolerance = 1e-3);

}  // namespace rotorub
