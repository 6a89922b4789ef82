#include "compare/measured/clipping.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rotorub {
namespace {

// Equal good samples in a row: [first, last).
struct Flat {
  std::size_t first, last;
  std::size_t size() const { return last - first; }
};

std::vector<Flat> flats_of(const MeasuredColumn& c) {
  std::vector<Flat> flats;
  for (std::size_t i = 0; i < c.value.size();) {
    std::size_t j = i + 1;
    if (c.sample[i] == Sample::kGood) {
      while (j < c.value.size() && c.sample[j] == Sample::kGood && c.value[j] == c.value[i]) ++j;
      flats.push_back({i, j});
    }
    i = j;
  }
  return flats;
}

// The least difference of two values: what a converter's steps are, and next to nothing where there is none.
double resolution(const MeasuredColumn& c) {
  std::vector<double> values;
  for (std::size_t i = 0; i < c.value.size(); ++i) {
    if (c.sample[i] == Sample::kGood) values.push_back(c.value[i]);
  }
  std::sort(values.begin(), values.end());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[i - 1]) least = std::min(least, values[i] - values[i - 1]);
  }
  return least;
}

// Seen from one end of a flat part: the samples outside it, nearest first (`step`: +1 or -1).
bool comes_fast(const MeasuredColumn& c, std::size_t inside, std::ptrdiff_t step, double limit, double least) {
  double outside[3] = {};
  std::size_t known = 0;
  for (auto at = static_cast<std::ptrdiff_t>(inside) + step;
       known < 3 && at >= 0 && at < static_cast<std::ptrdiff_t>(c.value.size()); at += step) {
    if (c.sample[static_cast<std::size_t>(at)] != Sample::kGood) break;
    outside[known++] = c.value[static_cast<std::size_t>(at)];
  }
  if (known == 0) return false;
  if (std::abs(limit - outside[0]) > least) return true;
  if (known < 3) return false;
  // Two samples on, by the parabola through the three.
  const double beyond = 6.0 * outside[0] - 8.0 * outside[1] + 3.0 * outside[2];
  return (limit > outside[0] ? beyond - limit : limit - beyond) > least;
}

void mark_at(double limit, const std::vector<Flat>& flats, std::size_t longest, double least, MeasuredColumn& c) {
  if (limit == 0.0) return;
  const auto is_met = [&](const Flat& flat) {
    return c.value[flat.first] == limit && flat.size() >= std::max(kLeastClipped, longest + 1) &&
           comes_fast(c, flat.first, -1, limit, least) &&
           (flat.last == c.value.size() || comes_fast(c, flat.last - 1, +1, limit, least));
  };
  if (std::none_of(flats.begin(), flats.end(), is_met)) return;
  for (std::size_t i = 0; i < c.value.size(); ++i) {
    if (c.sample[i] == Sample::kGood && c.value[i] == limit) c.sample[i] = Sample::kClipped;
  }
}

void mark_column(MeasuredColumn& c) {
  const std::vector<Flat> flats = flats_of(c);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Flat& flat : flats) {
    low = std::min(low, c.value[flat.first]);
    high = std::max(high, c.value[flat.first]);
  }
  if (!(low < high)) return;
  std::size_t longest = 1;  // elsewhere: of a sensor that is slower than its record
  for (const Flat& flat : flats) {
    const double value = c.value[flat.first];
    if (value != low && value != high && value != 0.0) longest = std::max(longest, flat.size());
  }
  const double least = kSteps * resolution(c);
  mark_at(high, flats, longest, least, c);
  mark_at(low, flats, longest, least, c);
}

}  // namespace

void mark_clipped(MeasuredRecord& record) {
  for (MeasuredColumn& c : record.columns) {
    if (c.what->clips) mark_column(c);
  }
}

}  // namespace rotorub
