#include "compare/study/answer.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "compare/base/format.h"
#include "compare/study/resync_text.h"

namespace rotorub {
namespace {

std::string reason(const SceneComparison& c, const Side& other, const SideDifference& d) {
  const Side& native = c.sides.front();
  for (const Side* side : {&native, &other}) {
    if (side->trajectory.status != Status::kOk) return side->early_end();
  }
  if (d.resync) return why(*d.resync, c.tolerance);
  const bool untouched = !native.metrics.first_touch && !other.metrics.first_touch;
  return (untouched ? "nothing touches; " : "") + why(d.judged(), c.tolerance);
}

std::string question_of(const std::string& label) {
  // As scene::ContactModel.
  constexpr const char* kQuestions[] = {"with the rigid law", "with Coulomb's friction beside it",
                                        "MuJoCo alone", "with the corrected cone"};
  const auto contact = scene::contact_model(label);
  return contact ? kQuestions[static_cast<int>(*contact)] : "MuJoCo alone, by its default solref";
}

// `rigid` is the native law in MuJoCo's step, `verlet`'s on the native coordinates.
std::string evidence_of(const SceneComparison& c, const Side& side) {
  if (side.label != to_string(scene::ContactModel::kRigid)) return "";
  if (c.own || c.scene.mujoco.rotor == scene::MujocoRotor::kSegments) {
    return "rigid shares the contact law with native, the rotor it does not: what agrees is "
           "evidence of the rotor.";
  }
  return "rigid shares law and step with native verlet: agreement says that it was put in right. "
         "That it is right, closed forms, Siconos, ODE and MuJoCo's own rotor say "
         "(compare/docs/findings.md, Evidence).";
}

std::string what_it_did(const SceneComparison& c, const SideDifference& d) {
  const std::string tolerance = percent_text(c.tolerance);
  if (d.trust == Trust::kYes) return "which agrees within " + tolerance;
  if (d.trust != Trust::kUndecidable) return "which is outside " + tolerance;
  return "of which nothing can be decided at " + tolerance + ": not taken for agreement";
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

std::vector<AnswerRow> answer(const SceneComparison& c) {
  std::vector<AnswerRow> rows;
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    const Side& side = c.sides[k + 1];
    const SideDifference& d = c.differences[k];
    rows.push_back({side.label, question_of(side.label), d.trust, reason(c, side, d),
                    side.timing.median, d.decides, evidence_of(c, side)});
  }
  return rows;
}

std::string whose_verdict(const SceneComparison& c) {
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    if (!c.differences[k].decides) continue;
    return fmt::format("Exit code: by {} (--contact), {}.", c.sides[k + 1].label,
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
