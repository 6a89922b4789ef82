#include "compare/tune/json.h"

#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/base/version.h"
#include "compare/engine/engine.h"
#include "compare/model_error/json.h"
#include "native_model/scene/reader.h"

namespace rotorub::tune {
namespace {

using nlohmann::json;

json setting_json(const JudgedSetting& judged, int modes) {
  const Setting& s = judged.setting;
  json errors = json::object(), intervals = json::object(), undecided = json::array();
  for (const JudgedFigure& f : judged.figures) {
    errors[f.figure->key] = number_or_null(f.deviation);
    intervals[f.figure->key] = number_or_null(f.interval);
    if (f.verdict == FigureVerdict::kUndecidable) undecided.push_back(f.figure->key);
  }
  const bool soft = s.contact != scene::ContactModel::kRigid;
  const auto given = [](bool has, double value) {
    return has && value > 0.0 ? json(value) : json(nullptr);
  };
  return {
      {"contact", scene::to_string(s.contact)},
      {"integrator", to_string(s.integrator)},
      {"step", s.step},
      {"modes", modes},
      // null: chosen from the step, or a contact that has none.
      {"solref_stiffness", given(soft, s.stiffness)},
      {"solref_damping", given(soft, s.damping)},
      {"friction_reference", given(s.contact == scene::ContactModel::kCone, s.friction_reference)},
      {"solver", to_string(s.solver)},
      {"us_per_step", judged.us_per_step > 0.0 ? json(judged.us_per_step) : json(nullptr)},
      {"seconds_per_second", number_or_null(judged.cost())},
      {"trusted", rotorub::to_string(judged.trust)},
      {"errors", errors},
      {"interval", intervals},
      {"undecidable", undecided},
      {"wrong", judged.wrong()},
      {"reason", !judged.failure.empty() ? judged.failure : judged.luck}};
}

json part_json(const ErrorPart& part) {
  json all = json::object();
  for (const auto& [figure, share] : part.figures) {
    all[figure->key] = number_or_null(share);
  }
  if (!part.reason.empty()) all["reason"] = part.reason;
  return all;
}

}  // namespace

json tune_json(const TuneResult& r) {
  const auto one = [&](const std::optional<std::size_t>& k) {
    return k ? setting_json(r.settings[*k], r.modes) : json(nullptr);
  };
  json best = json::array(), all = json::array();
  for (const std::size_t k : r.choice.best_by_contact) best.push_back(one(k));
  for (const JudgedSetting& s : r.settings) all.push_back(setting_json(s, r.modes));
  return {{"program", "rotorub"},
          {"version", program_version()},
          {"mujoco_version", mujoco_version()},
          {"scene", r.scene.name},
          {"scene_hash", scene::scene_hash(r.scene)},
          {"tolerance", r.tolerance},
          {"trusted", one(r.choice.trusted)},
          {"next_cheaper", one(r.choice.next_cheaper)},
          {"best_by_contact", best},
          {"nearest", one(r.choice.nearest)},
          {"model_error", model_error_json(r.model_error)},
          {"contact_error", part_json(r.errors.contact)},
          {"step_error", part_json(r.errors.step)},
          {"settings", all}};
}

}  // namespace rotorub::tune
