#include "compare/study/json.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/columns.h"
#include "compare/base/json.h"
#include "compare/base/version.h"
#include "compare/figures/figure.h"
#include "compare/measured/output.h"
#include "compare/model_error/model_error.h"
#include "compare/run_files/summary.h"
#include "compare/study/answer.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"

namespace rotorub {

// Structs that are written to JSON member by member.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Extrapolation, values, limit, order, uncertainty, valid, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Split, model_gap, step_error, native_step_error, uncertainty,
                                   valid, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Timing, us_per_step, median, lowest, highest)

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

json contact_json(const ContactResult& c) {
  json all = json::object();
  for (const ResyncFigure& f : resync_figures()) all[f.key] = c.*f.value;
  return all;
}

json divergence_json(const Divergence& d) {
  return {{"threshold", d.threshold},
          {"time", number_or_null(d.time)},
          {"max_distance", d.max_distance},
          {"rms_distance", d.rms_distance}};
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
    if (figures()[k].split) limits[figures()[k].key] = side.limits[k];
  }
  return {{"engine", side.engine},
          {"solref", side.solref.empty() ? json(nullptr) : json(side.solref)},
          {"summary", summary_json(scene, side.trajectory)},
          {"metrics", metrics_json(side.metrics)},
          {"step_to_zero", limits},
          {"timing", side.timing}};
}

// The shadow's figures and their differences from the native ones. Without a shadow: null figures
// and a reason.
json shadow_json(const SceneComparison& c) {
  if (!c.shadow.side) return {{"figures", nullptr}, {"reason", c.shadow.absent}};
  json by_figure = json::object();
  for (const JudgedFigure& f : c.shadow.figures) {
    by_figure[f.figure->key] = {{"native", f.native},
                                {"shadow", f.other},
                                {"difference", f.other - f.native},
                                {"deviation", f.is_absent() ? json() : json(f.deviation)}};
  }
  const Side& side = *c.shadow.side;
  return {{"engine", side.engine},
          {"commands_of", c.shadow.driven ? json(c.sides[1].label) : json(nullptr)},
          {"summary", summary_json(c.scene, side.trajectory)},
          {"figures", by_figure}};
}

// Rows and onsets of one contact model.
json resync_json(const Resync& r) {
  json rows = json::object(), onsets = json::array();
  for (const ResyncRow& row : r.rows) {
    rows[row.figure->key] = {{"native", row.native},
                             {"other", row.mujoco},
                             {"relative_to", row.figure->relative_to},
                             {"bias", row.bias},
                             {"median", row.median},
                             {"ninetieth", row.ninetieth},
                             {"worst", row.worst},
                             {"worst_signed", row.worst_signed},
                             {"worst_time", row.worst_time},
                             {"verdict", to_string(row.verdict)},
                             {"within", row.verdict == FigureVerdict::kWithin}};
  }
  for (const PredictedOnset& o : r.onsets) {
    onsets.push_back({{"touch", o.touch},
                      {"closing", o.closing},
                      {"end", o.end},
                      {"lasts", o.lasts},
                      {"status", to_string(o.status)},
                      {"native", contact_json(o.native)},
                      {"other", contact_json(o.mujoco)}});
  }
  return {{"figures", rows},
          {"onsets", onsets},
          {"left_out", r.left_out},
          {"failed", r.failed},
          {"failure", r.failure},
          {"shortest_flight_steps", kShortestFlight},
          {"largest_impact", r.largest_impact}};
}

// One row per contact model.
json answer_json(const SceneComparison& comparison) {
  json rows = json::array();
  for (const AnswerRow& row : answer(comparison)) {
    rows.push_back({{"scene", comparison.scene.name},
                    {"contact", row.contact},
                    {"question", row.question},
                    {"trusted", row.trusted},
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
    if (f.figure->split) entry["split"] = f.split;
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

ordered_json compare_columns_json() {
  return {{"compare.json runs.*.metrics", columns_json(metric_keys())},
          {"compare.json runs.*.summary", columns_json(summary_keys())},
          {"compare.json measured", columns_json(measured_keys())}};
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
      {"answer", answers},  // sorts first, so the file begins with it
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
