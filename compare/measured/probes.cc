#include "compare/measured/probes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotorub {
namespace {

MeasuredColumn* column(MeasuredRecord& record, std::string_view name) {
  const auto found = std::find_if(record.columns.begin(), record.columns.end(),
                                  [&](const MeasuredColumn& c) { return c.what->name == name; });
  return found == record.columns.end() ? nullptr : &*found;
}

void resolve(const Eigen::Matrix2d& places, MeasuredColumn& x, MeasuredColumn& y) {
  for (std::size_t i = 0; i < x.value.size(); ++i) {
    const Eigen::Vector2d place = places * Eigen::Vector2d(x.value[i], y.value[i]);
    x.value[i] = place.x();
    y.value[i] = place.y();
    const auto either = [&](Sample s) { return x.sample[i] == s || y.sample[i] == s; };
    x.sample[i] = y.sample[i] = either(Sample::kMissing)   ? Sample::kMissing
                                : either(Sample::kClipped) ? Sample::kClipped
                                                           : Sample::kGood;
    if (x.sample[i] == Sample::kMissing) x.value[i] = y.value[i] = 0.0;
  }
}

}  // namespace

void resolve_probes(MeasuredRecord& record, double first, double second) {
  if (!(std::abs(std::sin(second - first)) >= std::sin(kLeastApart))) {
    throw MeasuredError(
        fmt::format("two probes that see nearly the same tell no place; accepted are directions "
                    "{:.0f} degrees or more from one line",
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
    MeasuredColumn* const x = column(record, fmt::format("{}_x", what));
    MeasuredColumn* const y = column(record, fmt::format("{}_y", what));
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
