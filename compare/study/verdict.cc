#include "compare/study/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/base/format.h"
#include "compare/figures/figure.h"
#include "compare/metrics/metrics.h"
#include "compare/study/resync_text.h"

namespace rotorub {
namespace {

constexpr double kOftenEnough = 0.02;  // a difference in contact that deserves a sentence: 2 points
constexpr double kDeepPenetration = 0.05;  // of the clearance
constexpr double kDominates = 2.0;  // factor by which one part of a split must exceed the other

double percent(double share) { return 100.0 * share; }

// A share of time, with a decimal if it is small.
std::string time_share(double share) {
  return fmt::format("{:.{}f} %", percent(share), share > 0.0 && share < 0.01 ? 1 : 0);
}

double scatter(const Metrics& m) {
  return m.mean_force > 0.0 ? m.force_deviation / m.mean_force : 0.0;
}

const FigureDifference& of(const ComparedModel& m, const char* key) {
  return *std::ranges::find(m.figures, &figure(key), &FigureDifference::figure);
}

// Orders figures by their weight: those outside, then those within, then the other judged ones, and
// among equals by the deviation.
std::pair<FigureVerdict, double> weight(const FigureDifference& f) {
  return {f.verdict, std::abs(f.deviation)};
}

const FigureDifference& worst(const ComparedModel& m) {
  return *std::ranges::max_element(m.figures, {}, weight);
}

// The worst figure. If that has no split, the worst of the figures with its verdict whose split is
// known, or null.
const FigureDifference* worst_with_split(const ComparedModel& m) {
  const FigureDifference& off = worst(m);
  if (off.verdict == FigureVerdict::kNotJudged) return nullptr;
  if (off.figure->split) return &off;
  const FigureDifference* found = nullptr;
  for (const FigureDifference& f : m.figures) {
    if (f.verdict != off.verdict || !f.figure->split || !f.split.valid) continue;
    if (!found || weight(f) > weight(*found)) found = &f;
  }
  return found;
}

std::string attractor_sentence(const Side& native, const Side& other) {
  const Attractor a = native.metrics.settled.attractor;
  const Attractor b = other.metrics.settled.attractor;
  if (a == b || a == Attractor::kUnknown || b == Attractor::kUnknown) return {};
  return fmt::format(
      "it settles to something else: {} ({}), where the native model settles to {} ({})",
      to_string(b), explanation(b), to_string(a), explanation(a));
}

std::string contact_sentence(const Side& native, const Side& other) {
  const double a = native.metrics.lasting_fraction;
  const double b = other.metrics.lasting_fraction;
  if (b < a - kOftenEnough && other.metrics.settled.attractor == Attractor::kBouncing) {
    return fmt::format(
        "{} bounces: it is in lasting contact {} of the time instead of {}, with a force scatter "
        "of {:.0f} % of the mean (native: {:.0f} %)",
        other.label, time_share(b), time_share(a), percent(scatter(other.metrics)),
        percent(scatter(native.metrics)));
  }
  if (b < a - kOftenEnough) {
    return fmt::format("{} is in lasting contact {} of the time instead of {}", other.label,
                       time_share(b), time_share(a));
  }
  if (b > a + kOftenEnough) {
    return fmt::format(
        "{} stays in contact longer: {} of the time instead of {}, because a soft contact damps "
        "small bounces",
        other.label, time_share(b), time_share(a));
  }
  return {};
}

// The effect of a soft contact on impacts.
std::string impact_sentence(const ComparedModel& m) {
  const FigureDifference &mean = of(m, "mean_force"), &blow = of(m, "window_impulse");
  if (mean.verdict == FigureVerdict::kOutside || blow.verdict != FigureVerdict::kOutside) return {};
  return fmt::format(
      "the mean force is right ({}), but single impacts are not: the largest is {} N s instead "
      "of {} N s (native)",
      difference_text(mean), short_number(blow.other), short_number(blow.native));
}

// A step (s) that should bring a figure within the tolerance, if its error shrinks at least in
// proportion to the step: 1, 2 or 5 times a power of ten, as for --step. It is never less than
// about a tenth of the step, because the user pays for it.
std::string smaller_step(const FigureDifference& f, double step, double tolerance) {
  const double wanted = step * std::clamp(tolerance / std::abs(f.deviation), 0.1, 0.5);
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double leading = wanted / power;
  constexpr double kRounding = 1e-9;  // a leading 5 may be 4.9999999
  const double rounded = leading >= 5.0 - kRounding ? 5.0 : leading >= 2.0 - kRounding ? 2.0 : 1.0;
  return fmt::format("{:.3g}us", 1e6 * rounded * power);
}

// The source of a judged figure's difference. step: s, of the runs.
std::string split_sentence(const FigureDifference& f, double step, double tolerance) {
  const Split& s = f.split;
  if (s.difference == 0.0) return {};
  const std::string what = fmt::format("{} ({})", f.figure->label, difference_text(f));
  if (!s.valid) {
    if (std::abs(f.deviation) <= tolerance) return {};
    return fmt::format(
        "how much of the difference in {} is due to the step cannot be determined ({})", what,
        s.reason);
  }
  const double gap = std::abs(s.model_gap);
  const double by_step = std::abs(s.step_error - s.native_step_error);
  const double per_unit = f.figure->per_unit;
  const char* unit = f.figure->scale == Scale::kPoints ? "points" : f.figure->unit;
  if (gap > kDominates * by_step) {
    return fmt::format(
        "the difference in {} is due to the contact model: {:+.3g} {} remain as the step goes to "
        "0, so a smaller step does not help",
        what, s.model_gap * per_unit, unit);
  }
  if (by_step > kDominates * gap) {
    return fmt::format("the difference in {} is due to the step ({:+.3g} {}), so {}", what,
                       (s.step_error - s.native_step_error) * per_unit, unit,
                       std::abs(f.deviation) > tolerance
                           ? "try a smaller one: --step " + smaller_step(f, step, tolerance)
                           : "a smaller step reduces it");
  }
  return fmt::format(
      "the difference in {} is due to both the contact model ({:+.3g} {}) and the step ({:+.3g} "
      "{})",
      what, s.model_gap * per_unit, unit, (s.step_error - s.native_step_error) * per_unit, unit);
}

// For a figure that has no split, because it is a count.
std::string count_sentence(const FigureDifference& f, double step) {
  return fmt::format(
      "a smaller step shows whether the difference in {} ({}) is due to the step: --step {:.3g}us",
      f.figure->label, difference_text(f), 1e6 * 0.5 * step);
}

// Figures that scatter by more than the tolerance: "6.8 % in hard impacts".
template <class Scatter>
std::string scattered(const SceneComparison& c, const ComparedModel& m, Scatter scatter) {
  std::string apart;
  for (const FigureDifference& f : m.figures) {
    if (!f.figure->is_judged() || scatter(f) <= c.tolerance) continue;
    apart += fmt::format("{}{} in {}", apart.empty() ? "" : ", ", size_text(f, scatter(f)),
                         f.figure->label);
  }
  return apart;
}

std::string twins_sentence(const SceneComparison& c, const ComparedModel& m) {
  const std::string apart = scattered(
      c, m, [](const FigureDifference& f) { return f.floor > f.replay_floor ? f.floor : 0.0; });
  if (apart.empty()) return {};
  const int others = c.decides(m) ? c.decider_twins + 1 : 1;
  return fmt::format(
      "the motion is chaotic: {} native runs that start a few units in the last place apart differ "
      "by up to {}{}; {} native and {} MuJoCo run{} determine a difference to within its ±",
      c.twins + 1, apart,
      c.twin.time ? fmt::format(" and part at t = {:.4g} s", *c.twin.time) : std::string(),
      c.twins + 1, others, others == 1 ? "" : "s");
}

std::string open_loop_sentence(const SceneComparison& c, const ComparedModel& m) {
  const std::string apart =
      scattered(c, m, [](const FigureDifference& f) { return f.replay_floor; });
  if (apart.empty()) return {};
  return fmt::format(
      "the open loop does not hold the motion: commands of the native model's own loop, replayed "
      "into it at this step, already change {}; within that, {:.2g} % cannot be decided in replay",
      apart, percent(c.tolerance));
}

std::string penetration_sentence(const SceneComparison& c, const Side& other) {
  const std::vector<ContactFacts> contacts = contact_facts(c.scene);
  if (contacts.empty() || c.scene.is_compliant()) return {};
  const DeepestPenetration deepest = deepest_penetration(other.trajectory.statistics, contacts);
  if (deepest.share < kDeepPenetration) return {};
  const std::string where =
      contacts.size() > 1 ? " of contact " + c.scene.name_of(deepest.contact) : std::string();
  return fmt::format("the rotor sinks {:.0f} µm into the ring{}, {:.0f} % of the clearance",
                     1e6 * deepest.depth, where, percent(deepest.share));
}

}  // namespace

std::vector<std::string> reasons(const SceneComparison& comparison, const ComparedModel& model) {
  const Side &native = comparison.reference(model), &other = model.run;
  std::vector<std::string> all;
  const auto add = [&](std::string sentence) {
    if (!sentence.empty()) all.push_back(std::move(sentence));
  };
  // If the law fails everywhere, its text stands once.
  const auto failed = [](const Side& side) {
    return side.trajectory.status == Status::kControllerFailed;
  };
  const bool first = &model == &comparison.models.front();
  add(native.early_end(first || !failed(native)));
  add(other.early_end(!(failed(native) && failed(other))));
  if (other.trajectory.status == Status::kOk) add(other.trajectory.message);
  add(comparison.omission);
  if (!comparison.omission.empty()) return all;
  if (model.resync) {
    for (std::string& reason : resync_reasons(other.label, *model.resync)) add(reason);
    return all;
  }
  add(contact_sentence(native, other));
  add(attractor_sentence(native, other));
  add(impact_sentence(model));
  add(penetration_sentence(comparison, other));
  add(twins_sentence(comparison, model));
  add(open_loop_sentence(comparison, model));
  // Without a contact, no contact model can be the cause.
  const bool touches = native.metrics.first_touch || other.metrics.first_touch;
  if (!touches) return all;
  if (const FigureDifference* off = worst_with_split(model)) {
    add(split_sentence(*off, comparison.scene.run.step, comparison.tolerance));
  } else if (model.trust == Trust::kAveragesOnly) {
    add(count_sentence(worst(model), comparison.scene.run.step));
  }
  return all;
}

std::string headline(const SceneComparison& comparison, const ComparedModel& model) {
  const double tolerance = percent(comparison.tolerance);
  const Side &native = comparison.native, &other = model.run;
  if (native.trajectory.status != Status::kOk) {
    return fmt::format(
        "The native run did not reach the end of the run: there is nothing to "
        "compare MuJoCo's {} contact with.",
        other.label);
  }
  if (other.trajectory.status == Status::kControllerFailed) {
    return fmt::format("The controller failed beside MuJoCo's {} contact: nothing is judged.",
                       other.label);
  }
  if (other.trajectory.status != Status::kOk) {
    return fmt::format("MuJoCo's {} contact did not reach the end of the run.", other.label);
  }
  if (!comparison.omission.empty()) {
    return fmt::format("MuJoCo's {} contact: nothing can be decided within {:.3g} %, because {}.",
                       other.label, tolerance, comparison.omission);
  }
  if (model.resync) {
    return resync_headline(other.label, *model.resync, comparison.tolerance);
  }
  if (!native.metrics.first_touch && !other.metrics.first_touch) {
    return fmt::format(
        "Nothing touches, neither in MuJoCo ({}) nor in the native model: there is no "
        "contact force to judge.",
        other.label);
  }
  const FigureDifference& off = worst(model);
  switch (model.trust) {
    case Trust::kYes:
      return fmt::format(
          "MuJoCo's {} contact agrees with the native model within {:.3g} %: its contact forces "
          "can "
          "be trusted here.",
          other.label, tolerance);
    case Trust::kUndecidable:
      return fmt::format(
          "MuJoCo's {} contact: the motion does not repeat to within {:.3g} %, so nothing can be "
          "decided at this tolerance.",
          other.label, tolerance);
    case Trust::kAveragesOnly:
      return fmt::format(
          "MuJoCo's {} contact: its averages can be trusted within {:.3g} %, but not its single "
          "impacts: {} {}.",
          other.label, tolerance, off.figure->label, difference_text(off));
    case Trust::kNo:
      break;
  }
  return fmt::format("MuJoCo's {} contact is outside {:.3g} %: {} {}.", other.label, tolerance,
                     off.figure->label, difference_text(off));
}

}  // namespace rotorub
