#include "compare/study/answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

#include "compare/base/format.h"
#include "compare/study/comparison_runs.h"
#include "compare/study/resync_text.h"

namespace rotorub {
namespace {

std::string reason(const SceneComparison& c, const Side& other, const SideDifference& d) {
  const Side& native = c.sides.front();
  for (const Side* side : {&native, &other}) {
    if (side->trajectory.status != Status::kOk) return side->early_end();
  }
  if (!c.omission.empty())
    return c.omission + ", so no difference can be attributed to the contact";
  if (d.resync) return why(*d.resync, c.tolerance);
  const bool untouched = !native.metrics.first_touch && !other.metrics.first_touch;
  return (untouched ? "nothing touches, so there is no contact force to judge; " : "") +
         why(d.judged(), c.tolerance);
}

// The largest differences in plain words. If averages cannot be trusted, one of them comes first.
std::string plain_reason(const SceneComparison& c, const Side& other, const SideDifference& d) {
  const Side& native = c.sides.front();
  if (d.resync || native.trajectory.status != Status::kOk || other.trajectory.status != Status::kOk)
    return reason(c, other, d);
  if (!c.omission.empty()) return c.omission;
  const std::vector<JudgedFigure> judged = d.judged(), off = outside(judged);
  if (off.empty()) {
    return d.trust == Trust::kUndecidable
               ? "the motion does not repeat to within " + percent_text(c.tolerance)
               : "";
  }
  const auto average = std::find_if(off.begin(), off.end(), [](const JudgedFigure& f) {
    return f.figure->judged == Judged::kAverage;
  });
  if (average == off.end() || average == off.begin()) return plain_difference(off.front());
  return plain_difference(*average) + ", " + plain_difference(off.front());
}

std::string question_of(const std::string& label) {
  // In the order of scene::ContactModel.
  constexpr const char* kQuestions[] = {"with the rigid law", "with Coulomb's friction beside it",
                                        "MuJoCo alone", "with the corrected cone"};
  const auto contact = scene::contact_model(label);
  return contact ? kQuestions[static_cast<int>(*contact)] : "MuJoCo alone, by its default solref";
}

// `rigid` applies the native law in MuJoCo's step and takes the steps of `verlet` on the native
// coordinates.
std::string evidence_of(const SceneComparison& c, const Side& side) {
  if (side.label != to_string(scene::ContactModel::kRigid)) return "";
  if (c.own || c.scene.mujoco.rotor == scene::MujocoRotor::kSegments) {
    return "rigid has the contact law of native, but not its rotor: agreement is evidence for the "
           "rotor.";
  }
  return "rigid has the law and the step of native verlet: agreement shows only that they were put "
         "into MuJoCo correctly. Closed forms, Siconos, ODE and MuJoCo's own rotor show that they "
         "are right (compare/docs/findings.md, Evidence).";
}

std::string word_of(Showing showing, Trust trust) {
  return showing == Showing::kForces    ? to_string(trust)
         : showing == Showing::kNothing ? "no contact"
                                        : "not known";
}

std::string what_it_did(const SceneComparison& c, const SideDifference& d) {
  const std::string tolerance = percent_text(c.tolerance);
  if (d.trust == Trust::kYes) return "which agrees within " + tolerance;
  if (d.trust != Trust::kUndecidable) return "which is outside " + tolerance;
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

Showing showing(const SceneComparison& c, std::size_t side) {
  const Side &native = c.reference(side), &other = c.sides[side];
  if (native.trajectory.status != Status::kOk ||
      other.trajectory.status == Status::kControllerFailed) {
    return Showing::kFailed;
  }
  const bool touches = native.metrics.first_touch || other.metrics.first_touch;
  return touches || other.trajectory.status != Status::kOk ? Showing::kForces : Showing::kNothing;
}

std::vector<AnswerRow> answer(const SceneComparison& c) {
  std::vector<AnswerRow> rows;
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    const Side& side = c.sides[k + 1];
    const SideDifference& d = c.differences[k];
    const Showing shows = showing(c, k + 1);
    rows.push_back({side.label, question_of(side.label), d.trust, word_of(shows, d.trust),
                    shows == Showing::kForces ? tone_of(d.trust) : Tone::kPart, reason(c, side, d),
                    plain_reason(c, side, d), side.timing.median, d.decides, evidence_of(c, side)});
  }
  return rows;
}

std::vector<std::size_t> reading_order(const SceneComparison& c) {
  constexpr std::array kOrder{"cone", kConeDefault, "cone-coulomb", "coulomb", "rigid"};
  const auto place = [&](std::size_t difference) {
    const auto found = std::find(kOrder.begin(), kOrder.end(), c.sides[difference + 1].label);
    return found - kOrder.begin();
  };
  std::vector<std::size_t> order(c.differences.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  return order;
}

std::vector<std::size_t> sentence_rows(const SceneComparison& c) {
  std::vector<std::size_t> rows = reading_order(c);
  std::erase_if(rows, [&](std::size_t k) { return !scene::contact_model(c.sides[k + 1].label); });
  return rows;
}

std::string answer_sentence(const SceneComparison& c) {
  const std::vector<AnswerRow> rows = answer(c);
  std::string text;
  for (const std::size_t k : sentence_rows(c)) {
    const AnswerRow& row = rows[k];
    text += fmt::format("{}{}: {}{}", text.empty() ? "" : "; ", row.question, row.trusted,
                        row.plain.empty() ? "" : " (" + row.plain + ")");
  }
  return text + ".";
}

std::string whose_verdict(const SceneComparison& c) {
  if (c.status() != Status::kOk) return "The exit code is 3: a run did not come to its end.";
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    if (!c.differences[k].decides) continue;
    return fmt::format("The exit code is that of {} (--contact), {}.", c.sides[k + 1].label,
                       what_it_did(c, c.differences[k]));
  }
  return "";
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
  const std::string why = c.scene.gives() ? "" : cone_refusal(c.scene, c.own);
  return why.empty() ? "" : "MuJoCo alone is not shown: its cone " + why + ".";
}

std::string solref_note(const SceneComparison& c) {
  std::string all;
  for (const std::size_t k : reading_order(c)) {
    const Side& side = c.sides[k + 1];
    if (side.solref.empty()) continue;
    all += fmt::format("{}\"{}\" ({}{})", all.empty() ? "" : ", ", side.solref, side.label,
                       side.label == kConeDefault ? ", MuJoCo's default" : "");
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
        "shadow and twins are shown under those of {}.",
        c.sides.size() > 1 ? c.sides[1].label : "");
  }
  if (c.mode == CompareMode::kLockstep) return "";
  return fmt::format(
      "Resync: at every onset of contact the native model restarts from MuJoCo's state a step "
      "before it{} and predicts that contact by event.",
      c.commands ? ", under MuJoCo's commands," : "");
}

ThreeErrors three_errors(const SceneComparison& c, std::size_t side) {
  assert(side >= 1 && side < c.sides.size());
  ThreeErrors errors;
  for (const FigureDifference& d : c.differences[side - 1].figures) {
    const Figure& f = *d.figure;
    if (!f.is_judged() || !f.split || is_absent(c, f)) continue;
    const SplitShares shares = split_shares(f, f.value(c.reference(side).metrics), d.split);
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
