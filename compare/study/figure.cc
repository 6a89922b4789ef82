#include "compare/study/figure.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace rotorub {
namespace {

constexpr double kHertz = 1.0 / (2.0 * std::numbers::pi);
// m/s. Which part of its step an impact at 10 mm/s counts with moves the rms of a second by 0.03
// mm/s either way: what rests but for that is not told to a share of itself.
constexpr double kGapRateResolution = 1e-3;
constexpr auto kRel = Scale::kRelative;
constexpr auto kPts = Scale::kPoints;
constexpr auto kNo = Judged::kNo;
constexpr auto kAverage = Judged::kAverage;
constexpr auto kPeak = Judged::kPeak;

const Figure kFigures[] = {
    {"mean_force", "mean normal force", "N", 1.0, kRel, kAverage, true, true,
     "Normal impulse over the time from first touch, divided by that time.",
     [](const Metrics& m) { return m.mean_force; }},
    {"contact_fraction", "contact", "%", 100.0, kPts, kAverage, true, true,
     "Share of the time from first touch in which the rotor presses on the ring; an impact of a "
     "fixed step counts as one step.",
     [](const Metrics& m) { return m.contact_fraction; }},
    {"impulse_total", "total impulse", "N s", 1.0, kRel, kAverage, true, true,
     "All the normal momentum that the ring gave to the rotor.",
     [](const Metrics& m) { return m.impulse_total; }},
    {"force_deviation", "force scatter", "N", 1.0, kRel, kNo, true, true,
     "Standard deviation of the step-averaged normal force from first touch; impacts make it grow "
     "as the step shrinks.",
     [](const Metrics& m) { return m.force_deviation; }},
    {"peak_force", "peak force", "N", 1.0, kRel, kPeak, true, true,
     "Largest normal force, averaged over one step; an impact's grows as the step shrinks.",
     [](const Metrics& m) { return m.peak_force; }},
    {"peak_impulse", "largest impact", "N s", 1.0, kRel, kNo, true, false,
     "Largest normal impulse of one impact (soft contact: of one contact episode, lasting contact "
     "included).",
     [](const Metrics& m) { return m.peak_impulse; }},
    {"impacts", "impacts", "", 1.0, kRel, kNo, true, true,
     "Impacts that close faster than 0.1 mm/s (soft contact: contact episodes).",
     [](const Metrics& m) { return static_cast<double>(m.impacts); }},
    {"hard_impacts", "hard impacts", "", 1.0, kRel, kPeak, true, true,
     "Impacts faster than 1 % of the fastest: of an accumulation those that every useful step "
     "tells "
     "apart.",
     [](const Metrics& m) { return static_cast<double>(m.hard_impacts); }},
    {"friction_work", "friction work", "J", 1.0, kRel, kNo, true, true,
     "Energy that friction took; never positive.",
     [](const Metrics& m) { return m.friction_work; }},
    {"gap_rate_rms", "rms gap rate", "mm/s", 1e3, kRel, kPeak, true, true,
     "How restless the contact is: rms of the speed of the gap from first touch. Differences are "
     "relative to 1 mm/s where it is less.",
     [](const Metrics& m) { return m.gap_rate_rms; }, kGapRateResolution},
    {"whirl_frequency", "whirl, last fifth", "Hz", kHertz, kRel, kNo, true, true,
     "Mean turns per second of the rotor about the ring's centre; negative: backward.",
     [](const Metrics& m) { return m.settled.whirl_frequency; }},
    {"max_penetration", "penetration, max", "µm", 1e6, kRel, kNo, true, false,
     "How deep the rotor sank into the ring; a rigid contact allows what one step of flight gives.",
     [](const Metrics& m) { return m.max_penetration; }},
    {"rms_penetration", "penetration, rms", "µm", 1e6, kRel, kNo, true, false,
     "Rms of the penetration over the time from first touch.",
     [](const Metrics& m) { return m.rms_penetration; }},
    {"whirl_penetration", "penetration of one step", "µm", 1e6, kRel, kNo, false, false,
     "(v_t dt)^2 / (2 delta_0): what one step along the tangent costs a whirling rotor.",
     [](const Metrics& m) { return m.whirl_penetration; }},
    {"energy_residual", "energy balance", "ppm", 1e6, kRel, kNo, false, false,
     "|change of energy - work of all loads| over the largest energy met (of a contact at the end: its force over the clearance); 0 for exact integration.",
     [](const Metrics& m) { return m.energy_residual; }},
};

}  // namespace

std::span<const Figure> figures() { return kFigures; }

const Figure& figure(const std::string& key) {
  const Figure* found = nullptr;
  for (const Figure& f : kFigures) {
    if (key == f.key) found = &f;
  }
  assert(found);
  return *found;
}

double deviation(const Figure& figure, double native, double other) {
  const double difference = other - native;
  if (difference == 0.0 || figure.scale == Scale::kPoints) return difference;
  if (figure.resolution > std::abs(native)) {
    return (std::abs(other) - std::abs(native)) / figure.resolution;
  }
  if (native == 0.0) return std::copysign(std::numeric_limits<double>::infinity(), difference);
  return difference / native;
}

}  // namespace rotorub
