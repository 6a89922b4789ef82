// Numbers in a compact form for pages, as short text or in base 64.
#pragma once

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

// {"x", "y"}: a curve with at most 2 buckets + 2 of its points, chosen by thin().
inline constexpr std::size_t kPlotBuckets = 600;
nlohmann::json series(const std::vector<double>& x, const std::vector<double>& y,
                      std::size_t buckets = kPlotBuckets);

// The data of a page with every number rounded to seven digits, which keeps the page small. Tracks
// (pack/track.h) stay exact, because a player multiplies their quanta by large numbers.
nlohmann::json shortened(nlohmann::json data);

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
