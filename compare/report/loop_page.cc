#include "compare/report/loop_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/base/units.h"
#include "compare/modes/levitation_text.h"
#include "compare/report/plot_points.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr double kMicrons = 1e6;  // um per m

double decibels(double size) { return 20.0 * std::log10(size); }
std::string name_of(const LoopSensitivity& loop) {
  return fmt::format("bearing {} {}", loop.bearing + 1, loop.axis == 0 ? "x" : "y");
}

// Includes the peak as a point of the curve if it lies between two frequencies.
json sensitivity_curve(const Levitation& levitation, Eigen::Index k) {
  constexpr std::size_t kBuckets = 250;
  const LoopSensitivity& loop = levitation.loops[static_cast<std::size_t>(k)];
  std::vector<double> f = levitation.frequencies, y(f.size());
  for (std::size_t i = 0; i < f.size(); ++i)
    y[i] = decibels(levitation.sensitivities(k, static_cast<Eigen::Index>(i)));
  const auto at = std::lower_bound(f.begin(), f.end(), loop.frequency);
  if (at == f.end() || *at != loop.frequency) {
    y.insert(y.begin() + (at - f.begin()), decibels(loop.peak));
    f.insert(at, loop.frequency);
  }
  for (double& w : f) w *= kHz;
  const auto kept = thin(y, 0, y.size(), kBuckets);
  return {{"name", name_of(loop)},
          {"f", picked(f, kept, kDigits)},
          {"y", picked(y, kept, kDigits)},
          {"peak", {rounded(loop.frequency * kHz), rounded(decibels(loop.peak))}}};
}

// Up to `end` (s) with a fixed number of points, and the maximum between them.
json step_curve(const LoopSensitivity& loop, const StepResponse& step, double end) {
  constexpr double kPoints = 800.0;
  json t = json::array(), y = json::array();
  const auto add = [&](double time, double value) {
    t.push_back(rounded(kMilli * time));
    y.push_back(rounded(kMicrons * value));
  };
  double last = -end;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double top = step.largest_at.value_or(kNever);
  for (std::size_t k = 0; k < step.t.size() && step.t[k] <= end; ++k) {
    if (top < step.t[k]) {
      add(top, step.largest);
      top = kNever;
    }
    if (step.t[k] < last + end / kPoints) continue;
    add(last = step.t[k], step.y[k]);
  }
  const auto after = std::upper_bound(step.t.begin(), step.t.end(), step.settling_time);
  const double before = step.y[static_cast<std::size_t>(after - step.t.begin()) - 1] - step.steady;
  const double band = StepResponse::kBand * std::abs(step.overshoot ? step.steady : step.largest);
  json peak = nullptr;
  if (step.largest_at)
    peak = {rounded(kMilli * *step.largest_at), rounded(kMicrons * step.largest)};
  return {{"name", name_of(loop)},
          {"t", t},
          {"y", y},
          {"peak", peak},
          {"settled",
           {rounded(kMilli * step.settling_time),
            rounded(kMicrons * (step.steady + std::copysign(band, before)))}},
          {"steady", rounded(kMicrons * step.steady)}};
}

json plots_of(const Levitation& levitation) {
  json sensitivity = json::array(), step = json::array();
  double end = 0.0;
  for (const StepResponse& one : levitation.steps) end = std::max(end, 1.4 * one.settling_time);
  for (std::size_t k = 0; k < levitation.loops.size(); ++k) {
    if (!levitation.unstable())
      sensitivity.push_back(sensitivity_curve(levitation, static_cast<Eigen::Index>(k)));
    if (!levitation.steps.empty())
      step.push_back(step_curve(levitation.loops[k], levitation.steps[k], end));
  }
  return {{"sensitivity", sensitivity}, {"step", step}};
}

}  // namespace

json loop_plots(const RotorAnalysis& analysis) {
  json loops = json::array();
  for (std::size_t k = 0; k < analysis.levitations.size(); ++k) {
    const Levitation& levitation = analysis.levitations[k];
    if (!has_loop(levitation)) continue;
    loops.push_back(plots_of(levitation));
    loops.back()["title"] = levitation_title(analysis.spectra[k].speed, levitation);
  }
  return loops;
}

}  // namespace rotorub
