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

// The figure with the largest deviation among those outside, otherwise among those within,
// otherwise among the other judged ones.
const FigureDifference& worst(const ComparedModel& m) {
  return *std::ranges::max_element(m.figures, {}, [](const FigureDifference& f) {
    return std::pair(f.verdict, std::abs(f.deviation));
  });
}

std::string attractor_sentence(const Side& native, const Side& other) {
  const Attractor a = native.metrics.settled.attractor;
  const Attractor b = other.metrics.settled.attractor;
  if (a == b || a == Attractor::kUnknown || b == Attractor::kUnknown) return {};
  return fmt::format(
      "it settles to something else: {} ({}), where the native law settles to {} ({})",
      to_string(b), explanation(b), to_string(a), explanation(a));
}

std::string contact_sentence(const Side& native, const Side& other) {
  const double a = native.metrics.lasting_fraction;
  const double b = other.metrics.lasting_fraction;
  if (b < a - kOftenEnough) {
    return fmt::format(
        "{} bounces: in lasting contact {} of the time instead of {}, with a force scatter of "
        "{:.0f} % of the mean (rigid law: {:.0f} %)",
        other.label, time_share(b), time_share(a), percent(scatter(other.metrics)),
        percent(scatter(native.metrics)));
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
      "the mean force is right ({}), single impacts are not: the largest is {} N s, and {} N s "
      "by the rigid law",
      difference_text(mean), short_number(blow.other), short_number(blow.native));
}

// The source of the worst judged figure's difference.
std::string split_sentence(const FigureDifference& f, double tolerance) {
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
  const double step = std::abs(s.step_error - s.native_step_error);
  const double per_unit = f.figure->per_unit;
  const char* unit = f.figure->scale == Scale::kPoints ? "points" : f.figure->unit;
  if (gap > kDominates * step) {
    return fmt::format(
        "the difference in {} is due to the contact model: {:+.3g} {} remain as the step goes to "
        "0, so a smaller step does not help",
        what, s.model_gap * per_unit, unit);
  }
  if (step > kDominates * gap) {
    return fmt::format(
        "the difference in {} is due to the step: {:+.3g} of {:+.3g} {} vanish with it", what,
        (s.step_error - s.native_step_error) * per_unit, s.difference * per_unit, unit);
  }
  return fmt::format(
      "the difference in {} is due to both the contact model ({:+.3g} {}) and the step ({:+.3g} "
      "{})",
      what, s.model_gap * per_unit, unit, (s.step_error - s.native_step_error) * per_unit, unit);
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
  add(native.early_end());
  add(other.early_end());
  if (other.trajectory.status == Status::kOk) add(other.trajectory.message);
  add(comparison.omission);
  if (!comparison.omission.empty()) return all;
  if (model.resync) {
    for (std::string& reason : resync_reasons(other.label, *model.resync)) add(reason);
    return all;
  }
  const FigureDifference& off = worst(model);
  add(contact_sentence(native, other));
  add(attractor_sentence(native, other));
  add(impact_sentence(model));
  add(penetration_sentence(comparison, other));
  add(twins_sentence(comparison, model));
  add(open_loop_sentence(comparison, model));
  // Without a contact, no contact model can be the cause.
  const bool touches = native.metrics.first_touch || other.metrics.first_touch;
  if (touches && off.figure->split) add(split_sentence(off, comparison.tolerance));
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
          "MuJoCo's {} contact agrees with the native law within {:.3g} %: its contact forces can "
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
