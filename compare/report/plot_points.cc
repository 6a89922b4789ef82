#include "compare/report/plot_points.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
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
  nlohmann::json out = nlohmann::json::array();
  for (const std::size_t i : which) out.push_back(rounded(values[i], digits));
  return out;
}

namespace {

using Indices = std::vector<std::size_t>;

// Calls visit(begin, end) for each of `buckets` parts of [first, last).
template <class Visit>
void for_each_bucket(std::size_t first, std::size_t last, std::size_t buckets, Visit visit) {
  const std::size_t count = last - first;
  for (std::size_t k = 0; k < buckets; ++k) {
    const std::size_t begin = first + count * k / buckets;
    const std::size_t end = first + count * (k + 1) / buckets;
    if (begin < end) visit(begin, end);
  }
}

void keep_extremes(const std::vector<double>& y, std::size_t begin, std::size_t end,
                   Indices& kept) {
  const auto from = y.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto to = y.begin() + static_cast<std::ptrdiff_t>(end);
  const auto [low, high] = std::minmax_element(from, to);
  kept.push_back(static_cast<std::size_t>(low - y.begin()));
  kept.push_back(static_cast<std::size_t>(high - y.begin()));
}

Indices all_rows(std::size_t first, std::size_t last) {
  Indices rows(last - first);
  std::iota(rows.begin(), rows.end(), first);
  return rows;
}

Indices in_order(Indices kept, std::size_t first, std::size_t last) {
  kept.push_back(first);
  kept.push_back(last - 1);
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

}  // namespace

Indices thin(const std::vector<double>& y, std::size_t first, std::size_t last,
             std::size_t buckets) {
  assert(first <= last && last <= y.size() && buckets > 0);
  if (last - first <= 2 * buckets + 2) return all_rows(first, last);
  Indices kept;
  for_each_bucket(first, last, buckets,
                  [&](std::size_t begin, std::size_t end) { keep_extremes(y, begin, end, kept); });
  return in_order(std::move(kept), first, last);
}

std::string base64(std::string_view bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    // Three bytes to four digits of six bits.
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group <<= 8;
      if (i + k < bytes.size()) group |= static_cast<std::uint8_t>(bytes[i + k]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kLetters[(group >> (18 - 6 * k)) & 0x3f];
    }
  }
  return text;
}

}  // namespace rotorub
