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
    if (side->trajectory.status != Status::kOk) return side->early_end();
  }
  if (!c.omission.empty())
    return c.omission + ", so no difference can be attributed to the contact";
  if (m.resync) return why(*m.resync, c.tolerance);
  const bool untouched = !native.metrics.first_touch && !other.metrics.first_touch;
  return (untouched ? "nothing touches, so there is no contact force to judge; " : "") +
         why(m.judged(), c.tolerance);
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
    return "rigid has the contact law of native, but not its rotor: agreement is evidence for the "
           "rotor.";
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

void take(LargestError& largest, const Figure& figure, std::optional<double> share) {
  if (!share) {
    ++largest.untold;
  } else if (!largest.figure || std::abs(*share) > std::abs(largest.share)) {
    largest.figure = &figure;
    largest.share = *share;
  }
}

}  // namespace

const VerdictWords& verdict_words(const SceneComparison& c, const ComparedModel& m) {
  static constexpr VerdictWords kNoContact{"no contact", Tone::kPart, "not judged"};
  static constexpr VerdictWords kNotKnown{"not known", Tone::kPart, "not judged"};
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

std::vector<AnswerRow> answer(const SceneComparison& c) {
  std::vector<AnswerRow> rows;
  for (const ComparedModel& m : c.models) rows.push_back(answer_row(c, m));
  return rows;
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
  return fmt::format("The exit code refers to {} (--contact), {}.", decider.run.label,
                     what_it_did(c, decider.trust));
}

std::vector<std::string> own_notes(const SceneComparison& c) {
  if (!c.own) return {};
  std::vector<std::string> notes{
      "Native is a twin made from the mjModel of this machine: linear, for small motions about "
      "qpos0. " +
      std::string(c.twin_limits.empty() ? "It leaves nothing out that was found."
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

ThreeErrors three_errors(const SceneComparison& c, const ComparedModel& m) {
  ThreeErrors errors;
  for (const FigureDifference& d : m.figures) {
    const Figure& f = *d.figure;
    if (!f.is_judged() || !f.split || is_absent(c, f)) continue;
    const SplitShares shares = split_shares(f, f.value(c.reference(m).metrics), d.split);
    take(errors.contact, f, shares.contact);
    take(errors.step, f, shares.step);
  }
  if (c.model_error && !c.model_error->figures.empty()) {
    errors.modes.emplace();
    for (const FigureLimit& f : c.model_error->figures) take(*errors.modes, *f.figure, f.error);
  }
  return errors;
}

}  // namespace rotorub
