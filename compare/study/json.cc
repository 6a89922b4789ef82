#include "compare/study/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/base/version.h"
#include "compare/measured/json.h"
#include "compare/metrics/above_modes.h"
#include "compare/model_error/json.h"
#include "compare/study/answer.h"
#include "compare/study/mode_json.h"
#include "compare/study/verdict.h"
#include "native_model/rotor/contact_mass.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;

json residuals_json(const Residuals& r) {
  return {{"force_scale", r.force_scale},
          {"penetration", r.penetration},
          {"adhesion", r.adhesion},
          {"complementarity", r.complementarity},
          {"cone", r.cone},
          {"sliding", r.sliding},
          {"power", r.power},
          {"gap_error", r.gap_error}};
}

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

// Null: modal form, or no contact.
json above_modes_json(const std::optional<AboveModes>& above) {
  if (!above) return nullptr;
  return {{"highest_forward", above->band.forward},
          {"highest_backward", above->band.backward},
          {"contact_share", above->contact_share},
          {"friction_share", above->friction_share},
          {"fastest_whirl", above->fastest}};
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

json summary_json(const scene::Scene& scene, const Trajectory& trajectory) {
  const Statistics& s = trajectory.statistics;
  const double us =
      trajectory.steps > 0 ? 1e6 * trajectory.wall_s / static_cast<double>(trajectory.steps) : 0.0;
  json all = {
      {"program", "rotorub"},
      {"version", program_version()},
      {"mujoco_version", mujoco_version()},
      {"scene", scene.name},
      {"scene_hash", scene::scene_hash(scene)},
      {"engine", trajectory.engine},
      {"integrator", trajectory.integrator},
      {"contact_model", trajectory.contact_model},
      {"step", trajectory.step},
      {"steps", trajectory.steps},
      {"end", trajectory.end},
      {"wall_s", trajectory.wall_s},
      {"us_per_step", us},
      {"max_penetration", s.max_penetration},
      {"contact_fraction", trajectory.contact_fraction()},
      {"mean_force", trajectory.mean_force()},
      {"impulse_total", s.impulse_total},
      {"impacts", std::count_if(trajectory.impacts.begin(), trajectory.impacts.end(), counts)},
      {"energy_residual", s.energy_residual()},
      {"contact_mass", contact_mass_json(contact_mass(scene))},
      {"above_modes", above_modes_json(above_modes(scene, trajectory))},
      {"status", to_string(trajectory.status)},
      {"message", trajectory.message}};
  // rad/s, at the end, of a ring that turns.
  if (trajectory.has("ring_speed") && trajectory.rows() > 0) {
    all["ring_speed"] = trajectory.column("ring_speed").back();
  }
  return all;
}

json metrics_json(const Metrics& m) {
  json all = json::object();
  for (const Figure& f : figures()) all[f.key] = f.value(m);
  all["first_touch"] = number_or_null(m.first_touch);
  all["least_gap"] = number_or_null(m.least_gap);
  all["friction_impulse"] = m.friction_impulse;
  all["real_time_factor"] = m.real_time_factor;
  all["settled"] = {
      {"attractor", to_string(m.settled.attractor)}, {"from", m.settled.from},
      {"contact_share", m.settled.contact_share},    {"whirl_frequency", m.settled.whirl_frequency},
      {"spin_speed", m.settled.spin_speed},          {"impacts", m.settled.impacts}};
  all["residuals"] = residuals_json(m.residuals);
  return all;
}

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
