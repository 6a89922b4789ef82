#include "compare/measured/record.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rotorub {
namespace {

using namespace scene;

constexpr bool kHasLimit = true;

constexpr Measurable kMeasurables[] = {
    {"rotor_x", "", "rotor_x", "rotor_vx", kLength, Axis::kX, 0, kHasLimit,
     "rotor centre at the contact, along x"},
    {"rotor_y", "", "rotor_y", "rotor_vy", kLength, Axis::kY, 0, kHasLimit,
     "the same along y; the spin turns x to y"},
    {"ring_x", "stator_x", "stator_x", "stator_vx", kLength, Axis::kX, 0, kHasLimit,
     "centre of the ring, along x"},
    {"ring_y", "stator_y", "stator_y", "stator_vy", kLength, Axis::kY, 0, kHasLimit,
     "the same along y"},
    {"gap", "", "gap", "gap_rate", kLength, Axis::kNone, 0, kHasLimit,
     "between rotor and ring; 0: touching, negative: penetration"},
    {kContactForce, "", "", "", kForce, Axis::kNone, 1, kHasLimit,
     "normal force of the contact, impacts included, averaged over a sample"},
    {"normal_force", "", "normal_force", "", kForce, Axis::kNone, 2, false,
     "as in series.csv: of lasting contact, at the instant"},
    {"friction_force", "", "friction_force", "", kForce, Axis::kNone, 2, false,
     "as in series.csv: of lasting contact, at the instant"},
    {"control_x", "", "control_x", "", kForce, Axis::kX, 3, false,
     "force of the actuator on the ring, along x"},
    {"control_y", "", "control_y", "", kForce, Axis::kY, 3, false, "the same along y"},
    {"current_1", "", "current_1", "", kCurrent, Axis::kNone, 3, false,
     "of the actuator's first axis, beyond the bias"},
    {"current_2", "", "current_2", "", kCurrent, Axis::kNone, 3, false, "of its second axis"},
    {"spin_speed", "", "spin_speed", "", kSpin, Axis::kNone, 4, false,
     "of the rotor, positive from x to y"},
};

// A range of good samples in a row, or of equal ones: [first, last).
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

// At one end of a flat part: the samples outside it, nearest first, lie in the direction step (+1,
// -1).
bool comes_fast(const MeasuredColumn& c, std::size_t inside, std::ptrdiff_t step, double limit,
                double least) {
  std::vector<double> outside;
  for (auto at = static_cast<std::ptrdiff_t>(inside) + step; outside.size() < 3; at += step) {
    const auto i = static_cast<std::size_t>(at);  // -1 wraps to beyond the end
    if (i >= c.value.size() || c.sample[i] != Sample::kGood) break;
    outside.push_back(c.value[i]);
  }
  if (outside.empty()) return false;
  if (std::abs(limit - outside[0]) > least) return true;
  if (outside.size() < 3) return false;
  // Extrapolates the parabola through the three samples by two samples beyond the nearest one.
  const double beyond = 6.0 * outside[0] - 8.0 * outside[1] + 3.0 * outside[2];
  return (limit > outside[0] ? beyond - limit : limit - beyond) > least;
}

void mark_column(MeasuredColumn& c) {
  const std::vector<Stretch> flats = flats_of(c);
  std::vector<double> values;  // ascending, without repetitions
  for (const Stretch& flat : flats) values.push_back(c.value[flat.first]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() < 2) return;
  const double low = values.front(), high = values.back();
  // The smallest difference of two values: a converter's step, or next to nothing without a
  // converter.
  double step = high - low;
  for (std::size_t i = 1; i < values.size(); ++i) step = std::min(step, values[i] - values[i - 1]);
  const double least = kSteps * step;
  // Elsewhere, from a sensor that is slower than its record.
  std::size_t longest = kLeastClipped - 1;
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

void resolve(const Eigen::Matrix2d& places, MeasuredColumn& x, MeasuredColumn& y) {
  for (std::size_t i = 0; i < x.value.size(); ++i) {
    const Eigen::Vector2d place = places * Eigen::Vector2d(x.value[i], y.value[i]);
    x.value[i] = place.x();
    y.value[i] = place.y();
    x.sample[i] = y.sample[i] = both(x.sample[i], y.sample[i]);
    if (x.sample[i] == Sample::kMissing) x.value[i] = y.value[i] = 0.0;
  }
}

}  // namespace

std::span<const Measurable> measurables() { return kMeasurables; }

const Measurable& other_axis(const Measurable& what) {
  std::string name(what.name);
  name.back() = what.axis == Axis::kX ? 'y' : 'x';
  return *std::ranges::find(kMeasurables, name, &Measurable::name);
}

std::size_t MeasuredColumn::count(Sample kind) const {
  return static_cast<std::size_t>(std::count(sample.begin(), sample.end(), kind));
}

Sample both(Sample a, Sample b) {
  if (a == Sample::kMissing || b == Sample::kMissing) return Sample::kMissing;
  return a == Sample::kClipped ? a : b;
}

void mark_clipped(MeasuredRecord& record) {
  for (MeasuredColumn& c : record.columns) {
    if (c.what->clips) mark_column(c);
  }
}

void resolve_probes(MeasuredRecord& record, double first, double second) {
  if (!(std::abs(std::sin(second - first)) >= std::sin(kLeastApart))) {
    throw MeasuredError(
        fmt::format("two probes in nearly the same direction cannot locate the rotor; their "
                    "directions must be {:.0f} degrees or more from one line",
                    kLeastApart * 180.0 / std::numbers::pi));
  }
  Eigen::Matrix2d directions;
  directions << std::cos(first), std::sin(first), std::cos(second), std::sin(second);
  const Eigen::Matrix2d places = directions.inverse();
  mark_clipped(record);
  record.probe_x = first;
  record.probe_y = second;
  int pairs = 0;
  for (const char* what : {"rotor", "ring"}) {
    MeasuredColumn* const x = find_column(record.columns, fmt::format("{}_x", what));
    MeasuredColumn* const y = find_column(record.columns, fmt::format("{}_y", what));
    if (!x && !y) continue;
    if (!x || !y) {
      throw MeasuredError(fmt::format(
          "of two probes both are needed; {0}_x or {0}_y is missing in the record", what));
    }
    resolve(places, *x, *y);
    ++pairs;
  }
  if (pairs > 0) return;
  throw MeasuredError(
      "directions of probes are of rotor_x and rotor_y, or ring_x and ring_y, and "
      "the record has neither");
}

}  // namespace rotorub
