#include "compare/base/plot_points.h"

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cassert>
#include <charconv>
#include <cmath>
#include <numeric>

namespace rotorub {

namespace {

// The value rounded to `digits` significant digits.
double rounded(double value, int digits) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  double short_value = value;
  std::from_chars(text, end.ptr, short_value);
  return short_value;
}

}  // namespace

nlohmann::json series(const std::vector<double>& x, const std::vector<double>& y,
                      std::size_t buckets) {
  const auto at = [&](const std::vector<double>& values, const std::vector<std::size_t>& kept) {
    return list_of(kept, [&](std::size_t i) { return values[i]; });
  };
  const auto kept = thin(y, 0, y.size(), buckets);
  return {{"x", at(x, kept)}, {"y", at(y, kept)}};
}

nlohmann::json shortened(nlohmann::json data) {
  constexpr int kKept = 7;
  if (data.is_number_float()) return rounded(data.get<double>(), kKept);
  const bool is_track = data.is_object() && data.contains("quantum");
  if (!data.is_structured() || is_track) return data;
  for (nlohmann::json& member : data) member = shortened(std::move(member));
  return data;
}

std::vector<std::size_t> thin(const std::vector<double>& y, std::size_t first, std::size_t last,
                              std::size_t buckets) {
  assert(first <= last && last <= y.size() && buckets > 0);
  const std::size_t count = last - first;
  if (count <= 2 * buckets + 2) {
    std::vector<std::size_t> rows(count);
    std::iota(rows.begin(), rows.end(), first);
    return rows;
  }
  std::vector<std::size_t> kept = {first, last - 1};
  const auto row = [&](std::size_t i) { return y.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t k = 0; k < buckets; ++k) {
    const auto [low, high] = std::minmax_element(row(first + count * k / buckets),
                                                 row(first + count * (k + 1) / buckets));
    for (const auto& extreme : {low, high})
      kept.push_back(static_cast<std::size_t>(extreme - y.begin()));
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

nlohmann::json levels_data(const std::vector<double>& cells) {
  constexpr double kDecades = 4.0;
  const double most = cells.empty() ? 0.0 : *std::max_element(cells.begin(), cells.end());
  if (!(most > 0.0)) return nullptr;
  const double high = std::log10(most), low = high - kDecades;
  std::string levels;
  for (const double a : cells) {
    const double share = a > 0.0 ? (std::log10(a) - low) / kDecades : 0.0;
    levels += static_cast<char>(
        static_cast<unsigned char>(std::lround(255.0 * std::clamp(share, 0.0, 1.0))));
  }
  return {{"low", low}, {"high", high}, {"levels", base64(levels)}};
}

std::string base64(std::string_view bytes) {
  namespace iterators = boost::archive::iterators;
  using Digits = iterators::base64_from_binary<iterators::transform_width<const char*, 6, 8>>;
  // The last digit may take its missing bits from beyond the end, so zeros are appended.
  std::string padded(bytes);
  padded += '\0';
  std::string text(Digits(padded.data()), Digits(padded.data() + bytes.size()));
  text.append((3 - bytes.size() % 3) % 3, '=');
  return text;
}

}  // namespace rotorub
