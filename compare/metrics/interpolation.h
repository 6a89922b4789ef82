// Values between the rows of a table, at times that ascend; before the first row and after the last
// one the values there. Two rows or more; rows ascend.
#pragma once

#include <span>
#include <vector>

namespace rotorub {

std::vector<double> linear(std::span<const double> rows, std::span<const double> y,
                           std::span<const double> t);
// Hermite's cubic. rate: of y.
std::vector<double> cubic(std::span<const double> rows, std::span<const double> y,
                          std::span<const double> rate, std::span<const double> t);

// count times from `from` to `to`, both included.
std::vector<double> even_times(double from, double to, std::size_t count);

}  // namespace rotorub
