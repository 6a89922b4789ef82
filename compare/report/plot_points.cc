#include "compare/report/plot_points.h"

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cassert>
#include <charconv>
#include <cmath>
#include <numbers>
#include <numeric>

namespace rotorub {

double rounded(double value, int digits) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  double short_value = value;
  std::from_chars(text, end.ptr, short_value);
  return short_value;
}

nlohmann::json picked(const std::vector<double>& values, const std::vector<std::size_t>& which,
                      int digits) {
  return list_of(which, [&](std::size_t i) { return rounded(values[i], digits); });
}

double phase_degrees(std::complex<double> x, double last) {
  const double phase = 180.0 / std::numbers::pi * std::arg(x);
  return phase - 360.0 * std::round((phase - last) / 360.0);
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
  return {{"low", rounded(low, 4)}, {"high", rounded(high, 4)}, {"levels", base64(levels)}};
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
