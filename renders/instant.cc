#include "renders/instant.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renders/machine.h"

namespace rotorub::renders {

namespace {

constexpr double kForceShown = 0.98, kGapShown = 0.99;  // quantiles of forces and gaps
constexpr double kRoom = 1.1;                           // margin at the top of a linear scale
constexpr double kFarApart = 30.0;     // ratio of forces from which a linear scale cannot show both
constexpr double kMostDecades = 1e-7;  // least ratio of low to high of a logarithmic scale
constexpr double kLeastGap = 0.01;     // of the clearance, so that noise about 0 stays small

double high_or_one(double high) { return high > 0.0 ? high : 1.0; }

// Scale of forces in contact: the typical force of every run is visible, and the largest is near
// the top.
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
    const double begin = std::clamp(run->first_touch().value_or(from), from, to);
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

namespace {
constexpr int kTrailPoints = 96;
constexpr double kFramesOfATurn = 2.0;  // with fewer, the whirl seems to turn another way
constexpr double kFaintest = 0.15;      // weaker impacts are not drawn
}  // namespace

Instant instant_at(const Playback& playback, double t, const Scales& scales,
                   const InstantOptions& options) {
  Instant instant;
  instant.pose = playback.at(t);
  const double oldest = std::max(playback.start(), t - options.trail_time);
  instant.strobe = playback.strobe(oldest, t);
  // The default clock may show a part of the run so fast that the path would need more points.
  const bool drawn = !instant.strobe && !playback.strobe(oldest, t, (t - oldest) / kTrailPoints);
  if (!instant.strobe && options.frame_time > 0.0) {
    instant.strobe =
        playback.strobe(oldest, t, options.frame_time * kPointsOfATurn / kFramesOfATurn);
    if (instant.strobe) instant.strobe->spacing = options.frame_time;
  }
  for (int i = 0; drawn && i <= kTrailPoints; ++i) {
    instant.trail.push_back(playback.at(oldest + (t - oldest) * i / kTrailPoints).rotor);
  }

  const auto arrow = [](const ValueScale& scale, double force) {
    return scale.high > 0.0 ? ArrowShare{scale.share(force), scale.clips(force)} : ArrowShare{};
  };
  instant.normal = arrow(scales.force, instant.pose.normal_force);
  instant.friction = arrow(scales.force, std::abs(instant.pose.friction_force));
  instant.control = arrow(scales.control, instant.pose.control.norm());

  for (int k = 0; k < 2 && scales.current.high > 0.0; ++k) {
    const double ampere = instant.pose.current[k];
    instant.current[k] = std::copysign(scales.current.share(std::abs(ampere)), ampere);
  }

  const auto& strikes = playback.strikes();
  auto strike = std::upper_bound(strikes.begin(), strikes.end(), t,
                                 [](double time, const Strike& s) { return time < s.t; });
  while (strike != strikes.begin()) {
    --strike;
    const double age = (t - strike->t) / options.spark_time;
    if (age >= 1.0) break;
    const double strength = std::sqrt(scales.impulse.share(strike->impulse));
    if (strength > kFaintest) instant.sparks.push_back({strike->e_r, strength, 1.0 - age});
  }
  return instant;
}

DrawnSection drawn_section(const Machine& machine, const Pose& pose) {
  DrawnSection section;
  section.ring = pose.stator * machine.displaced(1.0);
  section.rotor = pose.rotor * machine.displaced(1.0);
  section.e_r = pose.e_r();
  section.e_t = {-section.e_r[1], section.e_r[0]};
  section.touch = section.ring;
  if (machine.contact) section.touch += machine.contact->ring_bore() * section.e_r;
  section.in_contact = pose.normal_force > 0.0;
  return section;
}

}  // namespace rotorub::renders
