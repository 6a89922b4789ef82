#include "compare/figures/figure.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace rotorub {
namespace {

constexpr double kHertz = 1.0 / (2.0 * std::numbers::pi);
// m/s. Which part of its step an impact at 10 mm/s counts with moves the rms of a second by 0.03
// mm/s either way: what rests but for that is not compared by a share of itself.
constexpr double kGapRateResolution = 1e-3;
constexpr auto kRel = Scale::kRelative;
constexpr auto kPts = Scale::kPoints;
constexpr auto kNo = Judged::kNo;
constexpr auto kAverage = Judged::kAverage;
constexpr auto kPeak = Judged::kPeak;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
double or_none(const std::optional<double>& value) { return value.value_or(kNone); }

const Figure kFigures[] = {
    {"mean_force", "mean normal force", "N", 1.0, kRel, kAverage, true, true,
     "Normal impulse over the time from first touch, divided by that time.",
     [](const Metrics& m) { return m.mean_force; }},
    {"lasting_fraction", "lasting contact", "%", 100.0, kPts, kAverage, true, true,
     "Share of the time from first touch in lasting contact: without the steps of impacts, and "
     "without what of a soft "
     "contact is shorter than 20 of the scene's steps.",
     [](const Metrics& m) { return m.lasting_fraction; }},
    {"impulse_total", "total impulse", "N s", 1.0, kRel, kAverage, true, true,
     "All the normal momentum that the ring gave to the rotor.",
     [](const Metrics& m) { return m.impulse_total; }},
    {"friction_work", "friction work", "J", 1.0, kRel, kAverage, true, true,
     "Energy that friction took; never positive. Differences are relative to 1 mJ where it is "
     "less.",
     [](const Metrics& m) { return m.friction_work; }, 1e-3},
    {"whirl_frequency", "whirl", "Hz", kHertz, kRel, kAverage, true, true,
     "Mean turns per second of the rotor about the ring's centre, over the last fifth of the run; "
     "negative: backward. Differences are relative to 1 Hz where it "
     "is less.",
     [](const Metrics& m) { return m.settled.whirl_frequency; }, 1.0 / kHertz},
    {"spin_speed", "spin", "rad/s", 1.0, kRel, kAverage, true, true,
     "Mean speed of a spin that is free, over the last fifth of the run.",
     [](const Metrics& m) { return or_none(m.spin_speed); }, 1.0},
    {"ring_speed", "ring speed", "rad/s", 1.0, kRel, kAverage, true, true,
     "Mean speed of a ring that turns, over the last fifth of the run.",
     [](const Metrics& m) { return or_none(m.ring_speed); }, 1.0},
    {"control_force", "control force, rms", "N", 1.0, kRel, kAverage, true, true,
     "What the controller asks of the actuator, over the whole run.",
     [](const Metrics& m) { return or_none(m.control_force); }, 0.1},
    {"near_miss", "least gap", "µm", 1e6, kRel, kAverage, true, true,
     "How near a rotor came that never touches. Differences are relative to 10 µm where it is "
     "less.",
     [](const Metrics& m) { return m.first_touch ? kNone : or_none(m.least_gap); }, 1e-5},
    {"impact_impulse", "largest impact", "N s", 1.0, kRel, kPeak, true, true,
     "Largest normal impulse of one impact of a rigid law.",
     [](const Metrics& m) { return or_none(m.impact_impulse); }},
    {"window_impulse", "largest impulse", "N s", 1.0, kRel, kPeak, true, true,
     "Largest normal impulse within 20 of the scene's steps, of which a soft contact makes an "
     "impact; what a rigid law has within "
     "them.",
     [](const Metrics& m) { return or_none(m.window_impulse); }},
    {"hard_impacts", "hard impacts", "", 1.0, kRel, kPeak, false, true,
     "Impacts (soft contact: contact episodes) faster than 1 % of the fastest: of an accumulation "
     "those that every useful step "
     "tells apart. Of less than 100, one more or less is 1 %.",
     [](const Metrics& m) { return static_cast<double>(m.hard_impacts); }, 100.0},
    {"gap_rate_rms", "rms gap rate", "mm/s", 1e3, kRel, kPeak, true, true,
     "How restless the contact is: rms of the speed of the gap from first touch. Differences are "
     "relative to 1 mm/s where it is less.",
     [](const Metrics& m) { return m.gap_rate_rms; }, kGapRateResolution},
    {"contact_fraction", "contact, impacts too", "%", 100.0, kPts, kNo, true, true,
     "Share of the time from first touch in which the rotor presses on the ring; an impact of a "
     "fixed step counts as one step.",
     [](const Metrics& m) { return m.contact_fraction; }},
    {"force_deviation", "force scatter", "N", 1.0, kRel, kNo, true, true,
     "Standard deviation of the step-averaged normal force from first touch; impacts make it grow "
     "as the step shrinks.",
     [](const Metrics& m) { return m.force_deviation; }},
    {"peak_force", "impulse / step, max", "N", 1.0, kRel, kNo, true, true,
     "Largest impulse of one step, divided by the step: no force of a rigid law, whose impact has "
     "an impulse and no force; it grows "
     "as the step shrinks.",
     [](const Metrics& m) { return m.peak_force; }},
    {"impacts", "impacts", "", 1.0, kRel, kNo, true, true,
     "Impacts that close faster than 0.1 mm/s (soft contact: contact episodes).",
     [](const Metrics& m) { return static_cast<double>(m.impacts); }},
    {"max_penetration", "penetration, max", "µm", 1e6, kRel, kNo, true, false,
     "How deep the rotor sank into the ring; a rigid contact allows what one step of flight gives.",
     [](const Metrics& m) { return m.max_penetration; }},
    {"rms_penetration", "penetration, rms", "µm", 1e6, kRel, kNo, true, false,
     "Rms of the penetration over the time from first touch.",
     [](const Metrics& m) { return m.rms_penetration; }},
    {"whirl_penetration", "one step's depth", "µm", 1e6, kRel, kNo, false, false,
     "(v_t dt)^2 / (2 delta_0): what one step along the tangent costs a whirling rotor.",
     [](const Metrics& m) { return m.whirl_penetration; }},
    {"energy_residual", "energy balance", "ppm", 1e6, kRel, kNo, false, false,
     "|change of energy - work of all loads| over the largest energy met (of a contact at the end: "
     "its force over the clearance); 0 for exact integration.",
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
  // The sign is that of the magnitude's growth, and a turn of the sense is the whole way.
  if (figure.resolution > std::abs(native)) {
    const double grows = native < 0.0 ? -1.0 : native == 0.0 && other < 0.0 ? -1.0 : 1.0;
    return grows * difference / figure.resolution;
  }
  if (native == 0.0) return std::copysign(std::numeric_limits<double>::infinity(), difference);
  return difference / native;
}

double share_of(const Figure& figure, double native, double size) {
  if (figure.scale == Scale::kPoints || size == 0.0) return std::abs(size);
  return std::abs(size) / std::max(std::abs(native), figure.resolution);
}

}  // namespace rotorub
