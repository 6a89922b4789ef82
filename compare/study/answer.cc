#include "compare/study/answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/base/format.h"
#include "compare/study/comparison_runs.h"
#include "compare/study/resync_text.h"

namespace rotorub {
namespace {

std::string reason(const SceneComparison& c, const ComparedModel& m) {
  const Side &native = c.native, &other = m.run;
  for (const Side* side : {&native, &other}) {
    const Status status = side->trajectory.status;
    if (status != Status::kOk) return side->early_end(status != Status::kControllerFailed);
  }
  if (!c.omission.empty())
    return c.omission + ", so no difference can be attributed to the contact";
  if (m.resync) return why(*m.resync, c.tolerance);
  const bool untouched = !native.metrics.first_touch && !other.metrics.first_touch;
  const std::string figures = why(m.judged(), c.tolerance);
  if (!untouched) return figures;
  return figures.empty() ? "nothing touches" : "nothing touches; " + figures;
}

// The largest differences in plain words. If averages cannot be trusted, one of them comes first.
std::string plain_reason(const SceneComparison& c, const ComparedModel& m) {
  if (m.resync || c.native.trajectory.status != Status::kOk ||
      m.run.trajectory.status != Status::kOk)
    return reason(c, m);
  if (!c.omission.empty()) return c.omission;
  const std::vector<JudgedFigure> judged = m.judged(), off = outside(judged);
  if (off.empty()) {
    return m.trust == Trust::kUndecidable
               ? "the motion does not repeat to within " + percent_text(c.tolerance)
               : "";
  }
  const auto average = std::find_if(off.begin(), off.end(), [](const JudgedFigure& f) {
    return f.figure->judged == Judged::kAverage;
  });
  if (average == off.end() || average == off.begin()) return plain_difference(off.front());
  return plain_difference(*average) + ", " + plain_difference(off.front());
}

// `rigid` applies the native law in MuJoCo's step and takes the steps of `verlet` on the native
// coordinates.
std::string evidence_of(const SceneComparison& c, const ComparedModel& m) {
  if (m.run.label != to_string(scene::ContactModel::kRigid)) return "";
  if (c.own || c.scene.mujoco.rotor == scene::MujocoRotor::kSegments) {
    return "rigid uses the same contact law as native, so agreement checks the motion of rotor and "
           "ring, not the law.";
  }
  return "rigid has the law and the step of native verlet: agreement shows only that they were put "
         "into MuJoCo correctly. Closed forms, Siconos, ODE and MuJoCo's own rotor show that they "
         "are right (compare/docs/findings.md, Evidence).";
}

std::string what_it_did(const SceneComparison& c, Trust trust) {
  const std::string tolerance = percent_text(c.tolerance);
  if (trust == Trust::kYes) return "which agrees within " + tolerance;
  if (trust != Trust::kUndecidable) return "which is outside " + tolerance;
  return "for which nothing can be decided at " + tolerance + "; this does not count as agreement";
}

// share: of the error in the figure, empty if it is unknown.
void take(LargestError& largest, const JudgedFigure& of, std::optional<double> share) {
  if (!share) {
    if (of.figure->split) ++largest.unknown;
    if (of.verdict == FigureVerdict::kOutside) largest.outside.push_back(of.figure);
  } else if (!largest.figure || std::abs(*share) > std::abs(largest.share)) {
    largest.figure = of.figure;
    largest.share = *share;
    largest.native = of.native;
  }
}

}  // namespace

const VerdictWords& verdict_words(const SceneComparison& c, const ComparedModel& m) {
  static constexpr VerdictWords kNoContact{"no contact", Tone::kPart};
  static constexpr VerdictWords kNotKnown{"not known", Tone::kPart};
  const Side &native = c.reference(m), &other = m.run;
  const Status status = other.trajectory.status;
  if (native.trajectory.status != Status::kOk || status == Status::kControllerFailed)
    return kNotKnown;
  const bool touches = native.metrics.first_touch || other.metrics.first_touch;
  return touches || status != Status::kOk ? words_of(m.trust) : kNoContact;
}

AnswerRow answer_row(const SceneComparison& c, const ComparedModel& m) {
  return {m.run.label,        m.kind().question,   verdict_words(c, m), reason(c, m),
          plain_reason(c, m), m.run.timing.median, c.decides(m),        evidence_of(c, m)};
}

std::vector<const ComparedModel*> reading_order(const SceneComparison& c) {
  std::vector<const ComparedModel*> order;
  for (const ComparedModel& m : c.models) order.push_back(&m);
  std::ranges::sort(order, {}, [](const ComparedModel* m) { return &m->kind(); });
  return order;
}

std::vector<AnswerRow> sentence_rows(const SceneComparison& c) {
  std::vector<AnswerRow> rows;
  for (const ComparedModel* m : reading_order(c)) {
    if (!m->kind().default_solref) rows.push_back(answer_row(c, *m));
  }
  return rows;
}

std::string whose_verdict(const SceneComparison& c) {
  if (c.status() != Status::kOk) return "The exit code is 3: a run did not come to its end.";
  if (c.models.empty()) return "";
  const ComparedModel& decider = c.models.front();
  if (c.is_untouched() && !decider.resync) {
    return fmt::format("The exit code refers to the motion of {} (--contact), {}.",
                       decider.run.label, what_it_did(c, decider.trust));
  }
  return fmt::format("The exit code refers to {} (--contact), {}.", decider.run.label,
                     what_it_did(c, decider.trust));
}

std::string no_contact_note(const SceneComparison& c) {
  if (!c.is_untouched()) return "";
  if (!c.scene.has_contact()) return "The scene has no [contact], so no force was judged.";
  const double gap = figure("near_miss").value(c.native.metrics);
  return fmt::format("Nothing touches in {}{}, so no force was judged. Run longer (--end), or {}.",
                     time_text(c.native.trajectory.end),
                     std::isnan(gap) ? "" : fmt::format(" (least gap {:.3g} µm)", 1e6 * gap),
                     c.own ? "start closer to the ring (keyframe `start`)"
                           : "start closer to the ring ([initial])");
}

std::vector<std::string> own_notes(const SceneComparison& c) {
  if (!c.own) return {};
  std::vector<std::string> notes{
      "Native is a model made from the mjModel of this machine: linear, for small motions about "
      "qpos0. " +
      std::string(c.twin_limits.empty() ? "It represents every part of the model that was checked."
                                        : "It leaves out:")};
  for (const std::string& limit : c.twin_limits) notes.push_back(limit + ".");
  return notes;
}

std::string cone_note(const SceneComparison& c) {
  const std::string why = c.scene.is_compliant() ? "" : cone_refusal(c.scene, c.own);
  return why.empty() ? "" : "MuJoCo alone is not shown: its cone " + why + ".";
}

std::string solref_note(const SceneComparison& c) {
  std::string all;
  for (const ComparedModel* m : reading_order(c)) {
    if (m->run.solref.empty()) continue;
    all += fmt::format("{}\"{}\" ({}{})", all.empty() ? "" : ", ", m->run.solref, m->run.label,
                       m->kind().default_solref ? ", MuJoCo's default" : "");
  }
  return all.empty() ? "" : "The soft contacts use solref " + all + ".";
}

std::string mode_note(const SceneComparison& c) {
  if (c.mode == CompareMode::kReplay && !c.commands) {
    return "Replay equals lockstep here: no controller commands the actuator.";
  }
  if (c.mode == CompareMode::kReplay) {
    return fmt::format(
        "Replay: each MuJoCo run is compared with a native run under its own commands; native, "
        "shadow and twins are shown under the commands of {}.",
        c.models.empty() ? "" : c.models.front().run.label);
  }
  if (c.mode == CompareMode::kLockstep) return "";
  return fmt::format(
      "Resync: at every onset of contact the native model restarts from MuJoCo's state a step "
      "before it{} and predicts that contact by event.",
      c.commands ? ", under MuJoCo's commands," : "");
}

std::string error_text(const LargestError& error) {
  std::vector<std::string> failing;
  for (const Figure* f : error.outside) failing.emplace_back(f->label);
  const std::string unknown =
      failing.empty() ? "" : fmt::format("not known for {}", fmt::join(failing, ", "));
  if (!error.figure) return unknown.empty() ? "not known" : unknown;
  std::string text = fmt::format("{} {}", deviation_text(*error.figure, error.native, error.share),
                                 error.figure->label);
  if (!unknown.empty()) return text + "; " + unknown;
  return error.unknown == 0 ? text : text + fmt::format(" ({} more not known)", error.unknown);
}

ThreeErrors three_errors(const SceneComparison& c, const ComparedModel& m) {
  ThreeErrors errors;
  for (const FigureDifference& d : m.figures) {
    const Figure& f = *d.figure;
    if (!f.is_judged() || is_absent(c, f)) continue;
    const SplitShares shares = f.split ? split_shares(f, d.native, d.split) : SplitShares{};
    take(errors.contact, d, shares.contact);
    take(errors.step, d, shares.step);
  }
  if (c.model_error && !c.model_error->figures.empty()) {
    errors.modes.emplace();
    for (const FigureLimit& f : c.model_error->figures) {
      const double native = f.values.empty() ? 0.0 : f.values.front();
      take(*errors.modes, JudgedFigure{.figure = f.figure, .native = native}, f.error);
    }
  }
  return errors;
}

}  // namespace rotorub
