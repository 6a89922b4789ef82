#include "compare/study/answer.h"

#include <fmt/format.h>

#include "compare/base/format.h"
#include "compare/engine/engine.h"

namespace rotorub {
namespace {

std::string reason(const SceneComparison& c, const Side& other, const SideDifference& d) {
  const Side& native = c.sides.front();
  for (const Side* side : {&native, &other}) {
    if (side->trajectory.status == Status::kOk) continue;
    return fmt::format("the {} run ended early ({}): {}", side->label,
                       to_string(side->trajectory.status), side->trajectory.message);
  }
  if (d.resync) return why(*d.resync, c.tolerance);
  const bool untouched = !native.metrics.first_touch && !other.metrics.first_touch;
  return (untouched ? "nothing touches; " : "") + why(d.judged(), c.tolerance);
}

std::string question_of(const std::string& label) {
  if (label == "cone-default") return "MuJoCo alone, by its default solref";
  switch (scene::contact_model(label).value()) {
    case scene::ContactModel::kRigid:
      return "with the rigid law";
    case scene::ContactModel::kCoulomb:
      return "with Coulomb's friction beside it";
    case scene::ContactModel::kCone:
      return "MuJoCo alone";
    case scene::ContactModel::kConeCoulomb:
      return "with the corrected cone";
  }
  return "";
}

// `rigid` is the native law in MuJoCo's step, `verlet`'s on the native coordinates.
std::string evidence_of(const SceneComparison& c, const Side& side) {
  if (side.label != to_string(scene::ContactModel::kRigid)) return "";
  if (c.own || c.scene.mujoco.rotor == scene::MujocoRotor::kSegments) {
    return "rigid shares the contact law with native, the rotor it does not: what agrees is "
           "evidence of the rotor.";
  }
  return "rigid shares law and step with native verlet: agreement says that it was put in right. "
         "That it is right, "
         "closed forms, Siconos, ODE and MuJoCo's own rotor say (README, Evidence).";
}

std::string what_it_did(const SceneComparison& c, const SideDifference& d) {
  const std::string tolerance = percent_text(c.tolerance);
  switch (d.trust) {
    case Trust::kYes:
      return "which agrees within " + tolerance;
    case Trust::kUndecidable:
      return "of which nothing can be decided at " + tolerance + ": not taken for agreement";
    case Trust::kAveragesOnly:
    case Trust::kNo:
      break;
  }
  return "which is outside " + tolerance;
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
  const std::string first = c.sides.size() > 1 ? c.sides[1].label : "";
  switch (c.mode) {
    case CompareMode::kLockstep:
      break;
    case CompareMode::kReplay:
      if (!c.commands) {
        return "Replay equals lockstep here: no controller commands the actuator.";
      }
      return "Replay: each MuJoCo run is compared with a native run under its own commands; "
             "native, "
             "shadow and twins are shown under those of " +
             first + ".";
    case CompareMode::kResync:
      return std::string(
                 "Resync: at every onset of contact the native model restarts from MuJoCo's "
                 "state a step before it") +
             (c.commands ? ", under MuJoCo's commands," : "") +
             " and predicts that contact by event.";
  }
  return "";
}

}  // namespace rotorub
