// The rows that a run is judged by, and values between them.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Values of y at the times t, which ascend; before the first row and after the last one the values
// there. Two rows or more; rows ascend.
std::vector<double> linear(std::span<const double> rows, std::span<const double> y,
                           std::span<const double> t);
std::vector<std::complex<double>> linear(std::span<const double> rows,
                                         std::span<const std::complex<double>> y,
                                         std::span<const double> t);
// Hermite's cubic. rate: of y.
std::vector<double> cubic(std::span<const double> rows, std::span<const double> y,
                          std::span<const double> rate, std::span<const double> t);

// rad/s: the mean of a speed from `from` (s) to the last row, by the angle that it turns. Both are
// columns of the run, which has two rows or more.
double mean_speed(const Trajectory& run, const char* angle, const char* speed, double from);

// What a turn of the spin takes to be told from its orders: by their velocities rows have twice the
// information.
inline constexpr std::size_t kRowsOfATurn = 6;

// count times from `from` to `to`, both included.
std::vector<double> even_times(double from, double to, std::size_t count);

inline constexpr std::size_t kRows = 50000;  // at most: every step, or every so many of them

// Times of rows: every step, or every so many so that there are at most `rows`, and the scene's
// requested times.
std::vector<double> dense_times(const scene::Run& run, std::size_t rows);

// The rows of a trajectory at the given times (those that it has), everything else as it is.
Trajectory rows_at(const Trajectory& trajectory, const std::vector<double>& times);

}  // namespace rotorub
