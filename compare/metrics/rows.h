// The rows on which a run is evaluated, and interpolation between them.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Values of y at the ascending times t; before the first and after the last row, the values there.
// At least two rows, ascending.
std::vector<double> linear(std::span<const double> rows, std::span<const double> y,
                           std::span<const double> t);
std::vector<std::complex<double>> linear(std::span<const double> rows,
                                         std::span<const std::complex<double>> y,
                                         std::span<const double> t);
// Cubic Hermite interpolation. rate: of y.
std::vector<double> cubic(std::span<const double> rows, std::span<const double> y,
                          std::span<const double> rate, std::span<const double> t);

// rad/s: mean of a speed from `from` (s) to the last row, computed from its angle. Both are names
// of columns of the run, which needs at least two rows.
double mean_speed(const Trajectory& run, const std::string& angle, const std::string& speed,
                  double from);

// Rows needed per turn of the spin to determine its orders; their velocities double the
// information.
inline constexpr std::size_t kRowsOfATurn = 6;

// `count` times from `from` to `to`, both included.
std::vector<double> even_times(double from, double to, std::size_t count);

inline constexpr std::size_t kRows = 50000;  // at most: every step, or every n-th step

// Times of rows: every step, or every n-th step so that there are at most `rows`, and the times
// that the scene requests.
std::vector<double> dense_times(const scene::Run& run, std::size_t rows);

// The trajectory with only those rows that are at the given times.
Trajectory rows_at(const Trajectory& trajectory, const std::vector<double>& times);

}  // namespace rotorub
