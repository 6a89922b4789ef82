#include "compare/metrics/distribution.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace rotorub {

Exceedance exceedance(std::vector<double> values, std::size_t most) {
  std::sort(values.begin(), values.end(), std::greater<>());
  Exceedance curve;
  const std::size_t n = values.size();
  const auto add = [&](std::size_t count) {
    if (!curve.count.empty() && curve.count.back() >= count) return;
    curve.value.push_back(values[count - 1]);
    curve.count.push_back(count);
  };
  const double growth = std::log(static_cast<double>(n)) / static_cast<double>(most - 1);
  for (std::size_t k = 0; n > 0 && k < most; ++k) {
    // The first even steps of ln count are less than 1, so every count is used there.
    const double even = std::exp(growth * static_cast<double>(k));
    add(std::clamp<std::size_t>(static_cast<std::size_t>(even + 1e-9), 1, n));
  }
  if (n > 0) add(n);
  return curve;
}

Histogram histogram(const std::vector<double>& t, const std::vector<double>& y, std::size_t parts) {
  Histogram out{0.0, std::vector<double>(parts, 0.0)};
  if (t.size() < 2) return out;
  const double top = *std::max_element(y.begin(), y.end()), whole = t.back() - t.front();
  if (!(top > 0.0) || !(whole > 0.0)) return out;
  out.width = top / static_cast<double>(parts);
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double low = std::min(y[i - 1], y[i]), high = std::max(y[i - 1], y[i]),
                 share = (t[i] - t[i - 1]) / whole;
    if (high <= 0.0 || share == 0.0) continue;
    const auto part_of = [&](double value) {
      return std::min(parts - 1, static_cast<std::size_t>(std::max(0.0, value) / out.width));
    };
    for (std::size_t k = part_of(low); k <= part_of(high); ++k) {
      const double from = out.width * static_cast<double>(k), to = from + out.width;
      // y is linear, so time is proportional to the change of y.
      const double inside = std::min(high, k + 1 == parts ? high : to) - std::max(low, from);
      out.share[k] += high > low ? share * inside / (high - low) : share;
    }
  }
  return out;
}

}  // namespace rotorub
