#include "compare/study/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rotorub {
namespace {

constexpr double kOftenEnough = 0.02;      // a lack of contact that is worth a sentence: 2 points
constexpr double kDeepPenetration = 0.05;  // of the clearance
constexpr double kDominates = 2.0;         // one part of a split over the other
constexpr double kStandsOut = 1.5;         // a peak or a scatter over the native one

double percent(double share) { return 100.0 * share; }

double scatter(const Metrics& m) {
  return m.mean_force > 0.0 ? m.force_deviation / m.mean_force : 0.0;
}

const FigureDifference& of(const SideDifference& d, const char* key) {
  return *std::find_if(d.figures.begin(), d.figures.end(), [&](const FigureDifference& f) {
    return std::string(f.figure->key) == key;
  });
}

// The judged figure that is furthest off.
const FigureDifference& worst(const SideDifference& d) {
  return *std::max_element(d.figures.begin(), d.figures.end(),
                           [](const FigureDifference& a, const FigureDifference& b) {
                             const double x = a.figure->judged ? std::abs(a.deviation) : -1.0;
                             const double y = b.figure->judged ? std::abs(b.deviation) : -1.0;
                             return x < y;
                           });
}

std::string signed_share(const FigureDifference& f, double deviation) {
  return f.figure->scale == Scale::kPoints ? fmt::format("{:+.2g} points", percent(deviation))
                                           : fmt::format("{:+.2g} %", percent(deviation));
}

std::string attractor_sentence(const Side& native, const Side& other) {
  const Attractor a = native.metrics.settled.attractor;
  const Attractor b = other.metrics.settled.attractor;
  if (a == b || a == Attractor::kUnknown || b == Attractor::kUnknown) return {};
  return fmt::format("it settles to something else: {} ({}), where the rigid law settles to {} ({})",
                     to_string(b), explanation(b), to_string(a), explanation(a));
}

std::string contact_sentence(const Side& native, const Side& other) {
  const double a = native.metrics.contact_fraction;
  const double b = other.metrics.contact_fraction;
  if (b < a - kOftenEnough) {
    return fmt::format(
        "{} chatters: in contact {:.0f} % of the time instead of {:.0f} %, with a force scatter of "
        "{:.0f} % of the mean (rigid law: {:.0f} %)",
        other.label, percent(b), percent(a), percent(scatter(other.metrics)),
        percent(scatter(native.metrics)));
  }
  if (b > a + kOftenEnough) {
    return fmt::format(
        "{} stays in contact longer: {:.0f} % of the time instead of {:.0f} %, because a soft "
        "contact spreads each impact over several steps and damps small bounces",
        other.label, percent(b), percent(a));
  }
  return {};
}

std::string scatter_sentence(const Side& native, const Side& other, const SideDifference& d) {
  const double a = native.metrics.peak_force;
  const double b = other.metrics.peak_force;
  const double mean = std::abs(of(d, "mean_force").deviation);
  if (a <= 0.0 || !std::isfinite(mean) || mean > 0.1) return {};
  if (b < kStandsOut * a && a < kStandsOut * b) return {};
  return fmt::format(
      "the mean force is about right ({:+.2g} %), single values are not: the largest force of a "
      "step is {:.2g} times the rigid law's",
      percent(of(d, "mean_force").deviation), b / a);
}

// Whose fault the worst judged figure is.
std::string split_sentence(const FigureDifference& f, double tolerance) {
  const Split& s = f.split;
  if (s.difference == 0.0) return {};
  const std::string what = fmt::format("{} ({})", f.figure->label, signed_share(f, f.deviation));
  if (!s.valid) {
    if (std::abs(f.deviation) <= tolerance) return {};
    return fmt::format("how much of the difference in {} is the step's cannot be told: {}", what,
                       s.reason);
  }
  const double gap = std::abs(s.model_gap);
  const double step = std::abs(s.step_error - s.native_step_error);
  const double unit = f.figure->per_unit;
  if (gap > kDominates * step) {
    return fmt::format(
        "the difference in {} is the contact model's: {:+.3g} {} remain as the step goes to 0, a "
        "smaller step does not help",
        what, s.model_gap * unit, f.figure->unit);
  }
  if (step > kDominates * gap) {
    return fmt::format("the difference in {} is the step's: {:+.3g} of {:+.3g} {} vanish with it",
                       what, (s.step_error - s.native_step_error) * unit, s.difference * unit,
                       f.figure->unit);
  }
  return fmt::format(
      "the difference in {} is the contact model's ({:+.3g} {}) and the step's ({:+.3g} {}) alike",
      what, s.model_gap * unit, f.figure->unit, (s.step_error - s.native_step_error) * unit,
      f.figure->unit);
}

std::string floor_sentence(const SceneComparison& c, const FigureDifference& f, double tolerance) {
  if (f.floor > tolerance) {
    return fmt::format(
        "the motion is chaotic: native runs that start one unit in the last place apart differ by "
        "up to {} in {} themselves{}, so a tolerance of {:.2g} % cannot be decided by one run",
        f.figure->scale == Scale::kPoints ? fmt::format("{:.2g} points", percent(f.floor))
                                          : fmt::format("{:.2g} %", percent(f.floor)),
        f.figure->label,
        c.twin.time ? fmt::format(" and part at t = {:.4g} s", *c.twin.time) : std::string(),
        percent(tolerance));
  }
  return {};
}

std::string penetration_sentence(const SceneComparison& c, const Side& other) {
  if (!c.scene.contact) return {};
  const double share = other.metrics.max_penetration / c.scene.contact->clearance;
  if (share < kDeepPenetration) return {};
  return fmt::format("the rotor sinks {:.0f} um into the ring, {:.0f} % of the clearance",
                     1e6 * other.metrics.max_penetration, percent(share));
}

}  // namespace

std::vector<std::string> reasons(const SceneComparison& comparison, const Side& other,
                                 const SideDifference& difference) {
  const Side& native = comparison.sides.front();
  std::vector<std::string> all;
  const auto add = [&](std::string sentence) {
    if (!sentence.empty()) all.push_back(std::move(sentence));
  };
  for (const Side* side : {&native, &other}) {
    if (side->trajectory.status != Status::kOk) {
      add(fmt::format("the {} run ended early ({}): {}", side->label,
                      to_string(side->trajectory.status), side->trajectory.message));
    }
  }
  const FigureDifference& off = worst(difference);
  add(contact_sentence(native, other));
  add(attractor_sentence(native, other));
  add(scatter_sentence(native, other, difference));
  add(penetration_sentence(comparison, other));
  add(floor_sentence(comparison, off, comparison.tolerance));
  add(split_sentence(off, comparison.tolerance));
  return all;
}

std::string headline(const SceneComparison& comparison, const Side& other,
                     const SideDifference& difference) {
  const double tolerance = percent(comparison.tolerance);
  if (other.trajectory.status != Status::kOk) {
    return fmt::format("MuJoCo with `{}` did not reach the end of the run.", other.label);
  }
  if (difference.within) {
    return fmt::format(
        "MuJoCo with `{}` agrees with the rigid law within {:.3g} %: its contact forces can be "
        "trusted here.",
        other.label, tolerance);
  }
  const FigureDifference& off = worst(difference);
  return fmt::format("MuJoCo with `{}` is outside {:.3g} %: {} is off by {}.", other.label,
                     tolerance, off.figure->label, signed_share(off, off.deviation));
}

}  // namespace rotorub
