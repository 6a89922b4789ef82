#include "compare/figures/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"

namespace rotorub {
namespace {

using nlohmann::json;

// m/s. The rms gap rate over 1 s changes by up to 0.03 mm/s with the part of the step in which an
// impact at 10 mm/s counts. A figure below the resolution is therefore not compared relative to
// itself.
constexpr double kGapRateResolution = 1e-3;
constexpr auto kRel = Scale::kRelative;
constexpr auto kPts = Scale::kPoints;
constexpr auto kCount = Scale::kCount;
constexpr auto kNo = Judged::kNo;
constexpr auto kAverage = Judged::kAverage;
constexpr auto kPeak = Judged::kPeak;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
template <auto Member>
double of(const Metrics& m) {
  if constexpr (std::is_same_v<decltype(m.*Member), const std::optional<double>&>) {
    return (m.*Member).value_or(kNone);
  } else {
    return static_cast<double>(m.*Member);
  }
}

const Figure kFigures[] = {
    {{"mean_force", "mean normal force", "N", 1.0,
      "Normal impulse of all contacts per time from first touch."},
     {kRel, kAverage},
     of<&Metrics::mean_force>},
    {{"lasting_fraction", "lasting contact", "%", 100.0,
      "Share of the time from first touch in lasting contact: without impacts and episodes of soft "
      "contact shorter than 20 of the scene's steps."},
     {kPts, kAverage},
     of<&Metrics::lasting_fraction>},
    {{"impulse_total", "total impulse", "N s", 1.0, "Total normal impulse."},
     {kRel, kAverage},
     of<&Metrics::impulse_total>},
    {{"friction_work", "friction work", "J", 1.0, "Work of friction; never positive."},
     {kRel, kAverage, 1e-3},
     of<&Metrics::friction_work>},
    {{"whirl_frequency", "whirl", "Hz", kHz,
      "Mean whirl about the ring's centre in the last fifth of the run; negative: backward."},
     {kRel, kAverage, 1.0 / kHz},
     [](const Metrics& m) { return m.settled.whirl_frequency; }},
    {{"spin_speed", "spin", "rad/s", 1.0,
      "Mean speed of a free spin in the last fifth of the run."},
     {kRel, kAverage, 1.0},
     of<&Metrics::spin_speed>},
    {{"ring_speed", "ring speed", "rad/s", 1.0,
      "Mean speed of a turning ring in the last fifth (summary.json: at the end); of several, the "
      "fastest."},
     {kRel, kAverage, 1.0},
     of<&Metrics::ring_speed>},
    {{"control_force", "rms control force", "N", 1.0,
      "Rms of the actuator's force on the ring over the whole run; of several, the largest."},
     {kRel, kAverage, 0.1},
     of<&Metrics::control_force>},
    {{"near_miss", "least gap", "µm", kMicro, "Smallest gap of a run without contact."},
     {kRel, kAverage, 1e-5},
     [](const Metrics& m) { return m.first_touch ? kNone : of<&Metrics::least_gap>(m); }},
    {{"contact_peak", "largest force", "N", 1.0, "Largest force of a compliant contact."},
     {kRel, kPeak},
     of<&Metrics::contact_peak>},
    {{"contact_depth", "largest depth", "µm", kMicro,
      "Largest penetration of a compliant contact."},
     {kRel, kPeak},
     of<&Metrics::contact_depth>},
    {{"contact_time", "time in contact", "ms", kMilli, "Time in compliant contact."},
     {kRel, kAverage},
     of<&Metrics::contact_time>},
    {{"impact_impulse", "largest impact", "N s", 1.0,
      "Largest normal impulse of one impact of a rigid law."},
     {kRel, kPeak},
     of<&Metrics::impact_impulse>},
    {{"window_impulse", "largest impulse", "N s", 1.0,
      "Largest normal impulse within 20 of the scene's steps."},
     {.scale = kRel, .judged = kPeak, .by_step = true},
     of<&Metrics::window_impulse>},
    {{"hard_impacts", "hard impacts", "", 1.0,
      "Impacts (soft contact: contact episodes) faster than 1 % of the fastest."},
     {kCount, kPeak, 1.0, false},
     of<&Metrics::hard_impacts>},
    {{"gap_rate_rms", "rms gap rate", "mm/s", kMilli,
      "Rms of the gap rate from first touch; several contacts: root of the sum of squares."},
     {kRel, kPeak, kGapRateResolution},
     of<&Metrics::gap_rate_rms>},
    {{"contact_fraction", "contact, impacts too", "%", 100.0,
      "Share of the time from first touch in contact; an impact of a fixed step counts as one "
      "step."},
     {kPts, kNo},
     of<&Metrics::contact_fraction>},
    {{"force_deviation", "force scatter", "N", 1.0,
      "Standard deviation of the step-averaged normal force; with impacts it grows as the step "
      "shrinks."},
     {.scale = kRel, .judged = kNo, .by_step = true},
     of<&Metrics::force_deviation>},
    {{"peak_force", "impulse / step, max", "N", 1.0,
      "Largest impulse of one step, divided by the step; with impacts it grows as the step "
      "shrinks."},
     {.scale = kRel, .judged = kNo, .by_step = true},
     of<&Metrics::peak_force>},
    {{"impacts", "impacts", "", 1.0,
      "Impacts that close faster than 0.1 mm/s (soft contact: contact episodes)."},
     {kCount, kNo, 1.0},
     of<&Metrics::impacts>},
    {{"max_penetration", "penetration, max", "µm", kMicro,
      "Largest penetration; with a rigid contact at most the distance travelled in one step."},
     {kRel, kNo, 0.0, true, false},
     of<&Metrics::max_penetration>},
    {{"rms_penetration", "penetration, rms", "µm", kMicro,
      "Rms of the penetration from first touch; several contacts: root of the sum of squares."},
     {kRel, kNo, 0.0, true, false},
     of<&Metrics::rms_penetration>},
    {{"whirl_penetration", "one step's depth", "µm", kMicro,
      "(v_t dt)^2 / (2 delta_0): penetration of a whirling rotor after a straight step."},
     {kRel, kNo, 0.0, false, false, true},
     of<&Metrics::whirl_penetration>},
    {{"energy_residual", "energy balance", "ppm", 1e6,
      "|change of energy - work of all loads| / largest energy (at least force times clearance of "
      "a contact closed at the end); 0 for exact integration."},
     {kRel, kNo, 0.0, false, false},
     of<&Metrics::energy_residual>},
};

const ResidualFigure kResiduals[] = {
    {"penetration", "largest penetration / delta_0", "law g ≥ 0",
     "Deepest penetration in a recorded row, over the clearance.", &Residuals::penetration},
    {"adhesion", "largest pull / F", "law λ ≥ 0",
     "Largest pull (a contact cannot pull), over the mean force in contact.", &Residuals::adhesion},
    {"complementarity", "largest gap times force / (delta_0 F)", "law g λ = 0",
     "Largest product of open gap and force: force without touch.", &Residuals::complementarity},
    {"cone", "largest excess of |friction| over mu times normal force / F", "friction cone",
     "Friction beyond mu times the normal force.", &Residuals::cone},
    {"sliding", "largest error of Coulomb's law in sliding / F", "sliding law",
     "While sliding: distance of the friction from -mu λ sign(slip).", &Residuals::sliding},
    {"power", "largest power gained from friction / (F times the largest slip)", "friction brakes",
     "Friction power above 0: friction that drives.", &Residuals::power},
    {"gap_error", "largest |gap - (delta_0 - distance of the centres)| / delta_0", "series itself",
     "Recorded gap against the gap of the recorded positions.", &Residuals::gap_error},
};

// The SI difference that is `deviation` on the scale of a figure: the inverse of deviation().
double difference_of(const Figure& figure, double native, double deviation) {
  if (figure.scale == Scale::kPoints || deviation == 0.0) return deviation;
  const double whole = std::max(std::abs(native), figure.resolution);
  return native < 0.0 ? -deviation * whole : deviation * whole;
}

}  // namespace

std::string figure_value(const FigureText& figure, double value) {
  return short_number(value * figure.per_unit);
}

std::string figure_label(const FigureText& figure) {
  return *figure.unit ? fmt::format("{}, {}", figure.label, figure.unit) : figure.label;
}

std::string_view figure_si_unit(const FigureText& figure) {
  const std::string_view unit = figure.unit;
  if (figure.per_unit == 1.0) return unit;
  if (unit == "mm/s") return "m/s";
  if (unit == "ms") return "s";
  if (unit == "Hz" || unit == "rpm") return "rad/s";
  return unit == "µm" ? "m" : "";  // %, ppm
}

std::span<const Figure> figures() { return kFigures; }

bool has_figure(const Metrics& metrics, const Figure& figure) {
  return std::isfinite(figure.value(metrics)) && !(figure.by_step && metrics.step == 0.0);
}

const Figure& figure(const std::string& key) {
  const auto found = std::find_if(std::begin(kFigures), std::end(kFigures),
                                  [&](const Figure& f) { return key == f.key; });
  assert(found != std::end(kFigures));
  return *found;
}

double deviation(const Figure& figure, double native, double other) {
  const double difference = other - native;
  if (difference == 0.0 || figure.scale == Scale::kPoints) return difference;
  // The sign is positive if the magnitude grows; a reversed sense counts with the whole difference.
  if (figure.resolution > std::abs(native)) {
    const double grows = native < 0.0 ? -1.0 : native == 0.0 && other < 0.0 ? -1.0 : 1.0;
    return grows * difference / figure.resolution;
  }
  if (native == 0.0) return std::numeric_limits<double>::infinity();
  return difference / native;
}

double share_of(const Figure& figure, double native, double size) {
  if (figure.scale == Scale::kPoints || size == 0.0) return size;
  return size / std::max(std::abs(native), figure.resolution);
}

SplitShares split_shares(const Figure& figure, double native, const Split& split) {
  const auto share = [&](double part) {
    const double apart = deviation(figure, native, native + part);
    return split.valid && std::isfinite(apart) ? std::optional(apart) : std::nullopt;
  };
  return {share(split.model_gap), share(split.step_error - split.native_step_error)};
}

std::string deviation_text(const Figure& figure, double deviation) {
  if (!figure.comparable) return "–";
  const char* unit = figure.scale == Scale::kPoints ? "points" : "%";
  if (!std::isfinite(deviation)) return deviation > 0.0 ? "+∞" : "-∞";
  const double percent = 100.0 * deviation;
  const double size = std::abs(percent);
  if (size < 0.005) return fmt::format("0.00 {}", unit);
  if (size < 10.0) return fmt::format("{:+.2f} {}", percent, unit);
  if (figure.scale == Scale::kPoints || percent < 1000.0) {
    return fmt::format("{:+.0f} {}", percent, unit);
  }
  return "×" + short_number(std::round(1.0 + deviation));
}

std::string size_text(const Figure& figure, double size) {
  if (figure.comparable && std::isfinite(size) && figure.scale != Scale::kPoints && size >= 10.0)
    return short_number(std::round(100.0 * size)) + " %";
  const std::string text = deviation_text(figure, size);
  return text.starts_with('+') ? text.substr(1) : text;
}

bool is_in_units(const Figure& figure, double native) {
  constexpr double kSmallCount = 100.0;
  switch (figure.scale) {
    case Scale::kCount:
      return std::abs(native) < kSmallCount;
    case Scale::kRelative:
      return std::abs(native) < figure.resolution;
    case Scale::kPoints:
      break;
  }
  return false;
}

std::string change_text(const Figure& figure, double change) {
  const std::string number = change == 0.0 ? "0" : fmt::format("{:+.3g}", change * figure.per_unit);
  return *figure.unit ? number + " " + figure.unit : number;
}

std::string deviation_text(const Figure& figure, double native, double deviation) {
  if (!is_in_units(figure, native) || !figure.comparable) return deviation_text(figure, deviation);
  return change_text(figure, difference_of(figure, native, deviation));
}

std::string size_text(const Figure& figure, double native, double size) {
  if (!is_in_units(figure, native) || !figure.comparable) return size_text(figure, size);
  const double change = std::abs(difference_of(figure, native, size));
  const std::string number = fmt::format("{:.2g}", change * figure.per_unit);
  return *figure.unit ? number + " " + figure.unit : number;
}

std::span<const ResidualFigure> residual_figures() { return kResiduals; }

json residuals_json(const Residuals& residuals) {
  json all = {{"force_scale", residuals.force_scale}};
  for (const ResidualFigure& r : kResiduals) all[r.key] = residuals.*r.value;
  return all;
}

}  // namespace rotorub
