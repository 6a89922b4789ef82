#include "compare/study/json.h"

#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/base/version.h"
#include "compare/figures/json.h"
#include "compare/measured/json.h"
#include "compare/model_error/json.h"
#include "compare/run_files/summary.h"
#include "compare/study/answer.h"
#include "compare/study/mode_json.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;

json divergence_json(const Divergence& d) {
  return {{"threshold", d.threshold},
          {"time", number_or_null(d.time)},
          {"max_distance", d.max_distance},
          {"rms_distance", d.rms_distance}};
}

json extrapolation_json(const Extrapolation& e) {
  return {{"values", e.values},           {"limit", e.limit}, {"order", e.order},
          {"uncertainty", e.uncertainty}, {"valid", e.valid}, {"reason", e.reason}};
}

json split_json(const Split& s) {
  return {{"model_gap", s.model_gap},
          {"step_error", s.step_error},
          {"native_step_error", s.native_step_error},
          {"uncertainty", s.uncertainty},
          {"valid", s.valid},
          {"reason", s.reason}};
}

json impact_json(const std::optional<Impact>& impact) {
  if (!impact) return nullptr;
  return {{"t", impact->t},
          {"normal_impulse", impact->normal_impulse},
          {"friction_impulse", impact->friction_impulse}};
}

json side_json(const scene::Scene& scene, const Side& side) {
  json limits = json::object();
  for (std::size_t k = 0; k < side.limits.size(); ++k) {
    if (figures()[k].split) limits[figures()[k].key] = extrapolation_json(side.limits[k]);
  }
  return {{"engine", side.engine},
          {"summary", summary_json(scene, side.trajectory)},
          {"metrics", metrics_json(side.metrics)},
          {"step_to_zero", limits},
          {"timing",
           {{"us_per_step", side.timing.us_per_step},
            {"median", side.timing.median},
            {"lowest", side.timing.lowest},
            {"highest", side.timing.highest}}}};
}

// One row a contact model.
json answer_json(const SceneComparison& comparison) {
  json rows = json::array();
  for (const AnswerRow& row : answer(comparison)) {
    rows.push_back({{"scene", comparison.scene.name},
                    {"contact", row.contact},
                    {"question", row.question},
                    {"trusted", to_string(row.trust)},
                    {"why", row.why},
                    {"us_per_step", row.us_per_step > 0.0 ? json(row.us_per_step) : json(nullptr)},
                    {"decides_exit_code", row.decides},
                    {"evidence", row.evidence.empty() ? json(nullptr) : json(row.evidence)}});
  }
  return rows;
}

json difference_json(const SceneComparison& comparison, const Side& side,
                     const SideDifference& difference) {
  json by_figure = json::object();
  for (const FigureDifference& f : difference.figures) {
    json entry = {{"native", f.native},
                  {"other", f.other},
                  {"difference", f.other - f.native},
                  {"deviation", f.is_absent() ? json() : json(f.deviation)},
                  {"twin_deviation", f.floor},
                  {"interval", f.interval},
                  {"least_told", f.least_told},
                  {"replay_floor", f.replay_floor},
                  {"judged", f.figure->is_judged()}};
    if (f.figure->is_judged()) {
      entry["within"] = f.verdict == FigureVerdict::kWithin;
      entry["verdict"] = to_string(f.verdict);
    }
    if (f.figure->split) entry["split"] = split_json(f.split);
    by_figure[f.figure->key] = std::move(entry);
  }
  json impacts = json::array();
  for (const ImpactPair& pair : difference.impacts) {
    impacts.push_back({{"native", impact_json(pair.a)}, {"other", impact_json(pair.b)}});
  }
  json all = {{"within", difference.within()},
              {"trusted", to_string(difference.trust)},
              {"decides", difference.decides},
              {"headline", headline(comparison, side, difference)},
              {"reasons", difference.reasons},
              {"figures", by_figure},
              {"divergence", divergence_json(difference.divergence)},
              {"impacts", impacts}};
  if (difference.resync) all["resync"] = resync_json(*difference.resync);
  return all;
}

}  // namespace

json comparison_json(const SceneComparison& comparison) {
  json sides = json::object();
  for (const Side& side : comparison.sides) {
    sides[side.label] = side_json(comparison.scene, side);
  }
  json differences = json::object();
  for (std::size_t k = 0; k < comparison.differences.size(); ++k) {
    const Side& side = comparison.sides[k + 1];
    differences[side.label] = difference_json(comparison, side, comparison.differences[k]);
  }
  return {
      {"answer", answer_json(comparison)},
      {"mode", to_string(comparison.mode)},
      {"mode_note", mode_note(comparison)},
      {"twins", comparison.twins},
      {"shadow", shadow_json(comparison)},
      {"own_model", comparison.own ? json{{"left_out", comparison.twin_limits}} : json(nullptr)},
      {"scene", comparison.scene.name},
      {"scene_hash", scene::scene_hash(comparison.scene)},
      {"step", comparison.scene.run.step},
      {"end", comparison.scene.run.end},
      {"status", to_string(comparison.status())},
      {"within", comparison.within()},
      {"model_error",
       comparison.model_error ? model_error_json(*comparison.model_error) : json(nullptr)},
      {"measured", comparison.measured ? measured_json(*comparison.measured) : json(nullptr)},
      {"runs", sides},
      {"differences", differences},
      {"twin", divergence_json(comparison.twin)}};
}

json comparisons_json(const std::vector<SceneComparison>& comparisons) {
  json scenes = json::array(), answers = json::array();
  bool within = !comparisons.empty();
  std::string decides = to_string(kDefaultContact);
  for (const SceneComparison& c : comparisons) {
    scenes.push_back(comparison_json(c));
    for (json& row : answer_json(c)) answers.push_back(std::move(row));
    for (const AnswerRow& row : answer(c)) {
      if (row.decides) decides = row.contact;
    }
    within = within && c.within();
  }
  return {
      {"answer", answers},  // sorted first: what the file begins with
      {"program", "rotorub"},
      {"version", program_version()},
      {"mujoco_version", mujoco_version()},
      {"mode", to_string(comparisons.empty() ? CompareMode::kLockstep : comparisons.front().mode)},
      {"contact", decides},
      {"tolerance", comparisons.empty() ? 0.0 : comparisons.front().tolerance},
      {"within", within},
      {"scenes", scenes}};
}

}  // namespace rotorub
