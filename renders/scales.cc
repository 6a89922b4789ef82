#include "renders/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renders/machine.h"

namespace rotorub::renders {

namespace {

constexpr double kForceShown = 0.98, kGapShown = 0.99;  // quantiles
constexpr double kRoom = 1.1;                           // above what is shown
constexpr double kFarApart = 30.0;     // of the runs' forces: no linear scale shows both
constexpr double kMostDecades = 1e-7;  // of a logarithmic scale: low against high
constexpr double kLeastGap = 0.01;     // of the clearance: so that noise about 0 stays small

double high_or_one(double high) { return high > 0.0 ? high : 1.0; }

// Forces in contact: every run's typical one is seen, the largest at the top.
ValueScale force_scale(std::span<const Playback* const> runs, double from, double to) {
  double largest = 0.0, smallest = 1e300;
  for (const Playback* run : runs) {
    const double high = run->force_quantile(kForceShown, from, to);
    if (!(high > 0.0)) continue;
    largest = std::max(largest, high);
    smallest = std::min(smallest, high);
  }
  if (largest <= kFarApart * smallest) return {0.0, kRoom * largest, false};
  const double high = std::pow(10.0, std::ceil(std::log10(largest)));
  const double low = std::pow(10.0, std::floor(std::log10(0.1 * smallest)));
  return {std::max(low, kMostDecades * high), high, true};
}

ValueScale gap_scale(std::span<const Playback* const> runs, double from, double to,
                     double clearance) {
  ValueScale scale{0.0, 0.0, false};
  for (const Playback* run : runs) {
    const double begin = std::clamp(run->first_touch(), from, to);
    scale.high = std::max(scale.high, 1e6 * kRoom * run->gap_quantile(kGapShown, begin, to));
    scale.low = std::min(scale.low, 1e6 * run->gap_quantile(0.0, begin, to));
  }
  scale.high = high_or_one(std::max(scale.high, 1e6 * kLeastGap * clearance));
  return scale;
}

}  // namespace

double ValueScale::share(double value) const {
  if (logarithmic) {
    return value > low ? std::min(1.0, std::log(value / low) / std::log(high / low)) : 0.0;
  }
  return std::clamp((value - low) / (high - low), 0.0, 1.0);
}

Scales make_scales(std::span<const Playback* const> runs, double from, double to,
                   double clearance) {
  Scales scales;
  scales.force = force_scale(runs, from, to);
  scales.gap = gap_scale(runs, from, to, clearance);
  double impulse = 0.0, control = 0.0, current = 0.0;
  for (const Playback* run : runs) {
    double own = 0.0;
    for (const Strike& strike : run->strikes()) {
      if (strike.t >= from && strike.t <= to) own = std::max(own, strike.impulse);
    }
    impulse = std::max(impulse, own);
    control = std::max(control, run->largest_control(from, to));
    current = std::max(current, run->largest_current(from, to));
    if (own > 0.0 && !(run->force_quantile(1.0, from, to) > 0.0)) scales.impulses = true;
  }
  scales.impulse = {0.0, high_or_one(kRoom * impulse), false};
  scales.control = {0.0, control, false};
  scales.current = {0.0, current, false};
  return scales;
}

std::string value_text(double value, const std::string& unit) {
  if (std::abs(value) < 1000.0) return fmt::format("{:.3g} {}", value, unit);
  std::string digits = fmt::format("{:.0f}", std::abs(value));
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), ",");
  }
  return (value < 0.0 ? "-" : "") + digits + " " + unit;
}

std::string length_text(double metres) {
  return metres >= 0.999e-4 ? fmt::format("{:.4g} mm", metres * 1e3)
                            : fmt::format("{:.4g} µm", metres * 1e6);
}

}  // namespace rotorub::renders
