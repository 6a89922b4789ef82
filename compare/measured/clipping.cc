#include "compare/measured/clipping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace rotorub {
namespace {

// Good samples in a row, or equal ones of them: [first, last).
struct Stretch {
  std::size_t first, last;
  std::size_t size() const { return last - first; }
};

std::vector<Stretch> flats_of(const MeasuredColumn& c) {
  std::vector<Stretch> flats;
  for (std::size_t i = 0; i < c.value.size(); ++i) {
    if (c.sample[i] != Sample::kGood) continue;
    const bool goes_on = !flats.empty() && flats.back().last == i && c.value[i] == c.value[i - 1];
    if (!goes_on) flats.push_back({i, i});
    flats.back().last = i + 1;
  }
  return flats;
}

// Seen from one end of a flat part: the samples outside it, nearest first (`step`: +1 or -1).
bool comes_fast(const MeasuredColumn& c, std::size_t inside, std::ptrdiff_t step, double limit,
                double least) {
  std::vector<double> outside;
  for (auto at = static_cast<std::ptrdiff_t>(inside) + step; outside.size() < 3; at += step) {
    const auto i = static_cast<std::size_t>(at);  // -1 is beyond the end too
    if (i >= c.value.size() || c.sample[i] != Sample::kGood) break;
    outside.push_back(c.value[i]);
  }
  if (outside.empty()) return false;
  if (std::abs(limit - outside[0]) > least) return true;
  if (outside.size() < 3) return false;
  // Two samples on, by the parabola through the three.
  const double beyond = 6.0 * outside[0] - 8.0 * outside[1] + 3.0 * outside[2];
  return (limit > outside[0] ? beyond - limit : limit - beyond) > least;
}

void mark_column(MeasuredColumn& c) {
  const std::vector<Stretch> flats = flats_of(c);
  std::vector<double> values;  // ascending, each once
  for (const Stretch& flat : flats) values.push_back(c.value[flat.first]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 2) return;
  const double low = values.front(), high = values.back();
  // The least difference of two: what a converter's steps are, and next to nothing without one.
  double step = high - low;
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  const double least = kSteps * step;
  std::size_t longest = kLeastClipped - 1;  // elsewhere: of a sensor that is slower than its record
  for (const Stretch& flat : flats) {
    const double value = c.value[flat.first];
    if (value != low && value != high && value != 0.0) longest = std::max(longest, flat.size());
  }
  for (const double limit : {high, low}) {
    const auto is_met = [&](const Stretch& flat) {
      return c.value[flat.first] == limit && flat.size() > longest &&
             comes_fast(c, flat.first, -1, limit, least) &&
             (flat.last == c.value.size() || comes_fast(c, flat.last - 1, +1, limit, least));
    };
    if (limit == 0.0 || std::none_of(flats.begin(), flats.end(), is_met)) continue;
    for (std::size_t i = 0; i < c.value.size(); ++i) {
      if (c.sample[i] == Sample::kGood && c.value[i] == limit) c.sample[i] = Sample::kClipped;
    }
  }
}

}  // namespace

void mark_clipped(MeasuredRecord& record) {
  for (MeasuredColumn& c : record.columns) {
    if (c.what->clips) mark_column(c);
  }
}

}  // namespace rotorub
