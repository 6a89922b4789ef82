// Numbers as pages hold them: few, short, and what few bytes say in base 64.
#pragma once

#include <complex>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace rotorub {

// make(element) of each, as a list.
template <class Range, class Make>
nlohmann::json list_of(const Range& range, Make make) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& element : range) all.push_back(make(element));
  return all;
}

// A plot shows no more than 6 or 7 significant digits, and the page stays small.
inline constexpr int kDigits = 6;

// The value to so many significant digits.
double rounded(double value, int digits = kDigits);
// factor * value of each, so rounded.
template <class Range>
nlohmann::json rounded_list(const Range& values, double factor = 1.0, int digits = kDigits) {
  return list_of(values, [&](double value) { return rounded(factor * value, digits); });
}
// Those of the values, each rounded.
nlohmann::json picked(const std::vector<double>& values, const std::vector<std::size_t>& which,
                      int digits);

// Degrees, of the phase of x: by whole turns the one nearest to `last`, so that a curve goes on
// beyond half a turn.
double phase_degrees(std::complex<double> x, double last);

// Fewer points for a plot that looks the same: extremes survive, so that no impact is lost. Indices
// (ascending, without doubles) of the rows kept of y[first, last): the first, the last, and the
// least and the greatest value of each of `buckets` parts of equal length. All rows where there are
// no more than 2 buckets + 2 of them. Asserts a range within y and buckets > 0.
std::vector<std::size_t> thin(const std::vector<double>& y, std::size_t first, std::size_t last,
                              std::size_t buckets);

// {"low", "high": log10 of the least shown and of the largest, "levels": base64 of a byte a cell}:
// amplitudes of four decades down from the largest by their logarithm. Null where all are 0.
nlohmann::json levels_data(const std::vector<double>& cells);

// RFC 4648, with padding, on one line.
std::string base64(std::string_view bytes);

}  // namespace rotorub
