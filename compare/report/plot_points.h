// Numbers in a compact form for pages, as short text or in base 64.
#pragma once

#include <complex>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace rotorub {

// The list of make(element) for each element.
template <class Range, class Make>
nlohmann::json list_of(const Range& range, Make make) {
  nlohmann::json all = nlohmann::json::array();
  for (const auto& element : range) all.push_back(make(element));
  return all;
}

// Plots show at most 6 or 7 significant digits, and fewer digits keep the page small.
inline constexpr int kDigits = 6;

// The value rounded to `digits` significant digits.
double rounded(double value, int digits = kDigits);
// factor * value for each value, rounded.
template <class Range>
nlohmann::json rounded_list(const Range& values, double factor = 1.0, int digits = kDigits) {
  return list_of(values, [&](double value) { return rounded(factor * value, digits); });
}
// The values at the indices `which`, rounded.
nlohmann::json picked(const std::vector<double>& values, const std::vector<std::size_t>& which,
                      int digits);

// The phase of x in degrees, with the whole turns that bring it nearest to `last`, so that a curve
// continues beyond half a turn.
double phase_degrees(std::complex<double> x, double last);

// Reduces y[first, last) to fewer points for a plot that looks the same. Extremes are kept, so that
// no impact is lost. Returns ascending indices without repetitions: the first and the last row, and
// the smallest and the largest value of each of `buckets` parts of equal length; all rows if there
// are at most 2 buckets + 2. Asserts a range within y and buckets > 0.
std::vector<std::size_t> thin(const std::vector<double>& y, std::size_t first, std::size_t last,
                              std::size_t buckets);

// {"low", "high": log10 of the smallest and the largest level, "levels": base64 with one byte per
// cell}: amplitudes within four decades of the largest, on a logarithmic scale. null if all are 0.
nlohmann::json levels_data(const std::vector<double>& cells);

// RFC 4648, with padding, on one line.
std::string base64(std::string_view bytes);

}  // namespace rotorub
