#include "compare/report/page_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/palette.h"
#include "compare/base/units.h"
#include "compare/base/version.h"
#include "compare/figures/figure.h"
#include "compare/report/figure_values.h"
#include "compare/report/measured_side.h"
#include "compare/report/plot_points.h"
#include "compare/study/answer.h"
#include "compare/study/resync_text.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"

namespace rotorub {

namespace {

using nlohmann::json;

std::string shadow_sentence(const SceneComparison& c) {
  if (!c.shadow.side) return "No shadow: " + c.shadow.absent;
  const std::string what = fmt::format("Shadow: the native stepper ({}) at MuJoCo's step",
                                       c.shadow.side->trajectory.integrator);
  if (!c.shadow.driven) {
    return what +
           ". What it is off by is the step's; what MuJoCo is off beyond it is the contact "
           "model's.";
  }
  return what + ", driven by the commands of " + c.models.front().run.label +
         ". What it is off by is the step's, and what the open loop makes of it.";
}

json resync_rows(const SceneComparison& c) {
  json rows = json::array();
  for (const ComparedModel& m : c.models) {
    if (!m.resync) continue;
    for (const ResyncRow& row : m.resync->rows) {
      const ResyncFigure& f = *row.figure;
      rows.push_back({{"side", m.run.label},
                      {"onsets", m.resync->onsets.size()},
                      {"label", f.label},
                      {"unit", f.unit},
                      {"meaning", f.meaning},
                      {"relative_to", f.relative_to},
                      {"native", figure_value(f, row.native)},
                      {"other", figure_value(f, row.mujoco)},
                      {"median", percents(row.median) + " %"},
                      {"ninetieth", percents(row.ninetieth) + " %"},
                      {"worst", signed_percent(row.worst_signed)},
                      {"time", fmt::format("{:.5g} s", row.worst_time)},
                      {"tone", tone_class(tone_of(row.verdict))},
                      {"verdict", to_string(row.verdict)}});
    }
  }
  return rows;
}

json verdict_values(const SceneComparison& c) {
  return list_of(reading_order(c), [&](const ComparedModel* m) -> json {
    const VerdictWords& words = verdict_words(c, *m);
    return {{"tone", tone_class(words.tone)},
            {"mark", words.mark},
            {"headline", headline(c, *m)},
            {"has_reasons", !m->reasons.empty()},
            {"reasons", m->reasons}};
  });
}

bool knows_modes(const SceneComparison& c) {
  return c.model_error && !c.model_error->figures.empty();
}

json error_values(const char* of, const LargestError& error) {
  if (!error.figure) return {{"of", of}, {"value", "–"}, {"label", ""}, {"note", "not known"}};
  return {{"of", of},
          {"value", deviation_text(*error.figure, error.share)},
          {"label", error.figure->label},
          {"note",
           error.untold > 0 ? fmt::format("({} more not known)", error.untold) : std::string()}};
}

// One row per contact model, all of equal rank. A column of errors that are unknown in all rows is
// left out.
json answer_values(const SceneComparison& c) {
  const bool modes = knows_modes(c);
  return list_of(reading_order(c), [&](const ComparedModel* m) -> json {
    const AnswerRow row = answer_row(c, *m);
    const ThreeErrors errors = three_errors(c, *m);
    json all = {error_values("contact model", errors.contact), error_values("step", errors.step)};
    if (modes) all.push_back(error_values("modes kept", *errors.modes));
    return {{"errors", all},
            {"plain", row.plain},
            {"contact", row.contact},
            {"question", row.question},
            {"tone", tone_class(row.verdict.tone)},
            {"mark", row.verdict.mark},
            {"trusted", row.verdict.word},
            {"why", row.why},
            {"cost", row.us_per_step > 0.0 ? fmt::format("{:.3g} µs", row.us_per_step) : "–"},
            {"decides", row.decides},
            {"evidence", row.evidence}};
  });
}

// The rows of the answer's sentence with their tones.
json clause_values(const SceneComparison& c) {
  json clauses = json::array();
  for (const AnswerRow& row : sentence_rows(c)) {
    clauses.push_back({{"question", row.question},
                       {"tone", tone_class(row.verdict.tone)},
                       {"trusted", row.verdict.word},
                       {"plain", row.plain},
                       {"more", true}});
  }
  if (!clauses.empty()) clauses.back()["more"] = false;
  return clauses;
}

json impact_rows(const SceneComparison& c) {
  std::size_t count = 0;
  for (const ComparedModel& m : c.models) count = std::max(count, m.impacts.size());
  std::vector<std::vector<Impact>> columns;
  for (const Side* side : c.sides()) columns.push_back(first_impacts(side->trajectory, count));
  json rows = json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const json cells = list_of(columns, [&](const std::vector<Impact>& column) -> json {
      if (i >= column.size()) return {{"time", "–"}, {"impulse", "–"}};
      return {{"time", fmt::format("{:.4f}", kMilli * column[i].t)},
              {"impulse", short_number(kMilli * column[i].normal_impulse)}};
    });
    rows.push_back({{"number", i + 1}, {"cells", cells}});
  }
  return rows;
}

std::string part_text(const Divergence& d) {
  return d.time ? fmt::format("part by more than {:.3g} µm at t = {:.5g} s", 1e6 * d.threshold,
                              *d.time)
                : fmt::format("never part by more than {:.3g} µm", 1e6 * d.threshold);
}

std::string divergence_text(const SceneComparison& c) {
  std::string text =
      "Rotor positions: native runs that start a few units in the last place apart " +
      part_text(c.twin);
  for (const ComparedModel& m : c.models)
    text += fmt::format("; native and {} {}", m.run.label, part_text(m.divergence));
  return text + ".";
}

json condition_values(const SceneComparison& c) {
  json rows = json::array();
  const auto add = [&](const char* name, std::string value) {
    rows.push_back({{"name", name}, {"value", std::move(value)}});
  };
  add("rotorub", program_version());
  add("MuJoCo", mujoco_version());
  add("scene hash", scene::scene_hash(c.scene));
  add("step", time_text(c.scene.run.step));
  add("tolerance", percent_text(c.tolerance));
  add("repeated runs",
      fmt::format("{} of native, from starts a few units in the last place apart", c.twins));
  for (const Side* side : c.sides()) {
    const Trajectory& t = side->trajectory;
    add(side->label.c_str(), fmt::format("{}, integrator {}, contact {}, {}", t.engine,
                                         t.integrator, t.contact_model, to_string(t.status)));
  }
  return rows;
}

}  // namespace

std::vector<PageColumn> page_columns(const SceneComparison& c) {
  std::vector<PageColumn> columns{{&c.native, {}, false}};
  if (c.shadow.side) columns.push_back({&*c.shadow.side, c.shadow.figures, false});
  for (const ComparedModel& m : c.models) columns.push_back({&m.run, m.judged(), true});
  return columns;
}

json scene_values(const SceneComparison& c) {
  const json impacts = impact_rows(c);
  const json resync = resync_rows(c);
  const json ladder = ladder_values(c);
  const json measured = measured_values(c.measured);
  return {{"name", c.scene.name},
          {"has_measured", !measured.is_null()},
          {"measured", measured.is_null() ? json::array() : json::array({measured})},
          {"cone_note", cone_note(c)},
          {"mode_note", mode_note(c)},
          {"solref_note", solref_note(c)},
          {"own_notes", own_notes(c)},
          {"by_figures", c.mode != CompareMode::kResync},
          {"resyncs", c.mode == CompareMode::kResync},
          {"resync", resync},
          {"shortest_flight", kShortestFlight},
          {"columns", column_values(c)},
          {"shadow", shadow_sentence(c)},
          {"answer", answer_values(c)},
          {"clauses", clause_values(c)},
          {"knows_modes", knows_modes(c)},
          {"whose", whose_verdict(c)},
          {"step", time_text(c.scene.run.step)},
          {"end", time_text(c.scene.run.end)},
          {"hash", scene::scene_hash(c.scene)},
          {"sides", list_of(c.sides(),
                            [](const Side* side) -> json {
                              return {{"label", side->label}};
                            })},
          {"verdicts", verdict_values(c)},
          {"judged", figure_rows(c, true)},
          {"all", figure_rows(c, false)},
          {"splits", split_rows(c, true)},
          {"unsplit", split_rows(c, false)},
          {"has_unsplit", !split_rows(c, false).empty()},
          {"unsplit_count", split_rows(c, false).size()},
          {"has_ladder", !ladder.is_null()},
          {"ladder", ladder.is_null() ? json::array() : json::array({ladder})},
          {"residuals", residual_rows(c)},
          {"cost", cost_rows(c)},
          {"has_impacts", !impacts.empty()},
          {"impacts", impacts},
          {"divergence", divergence_text(c)},
          {"conditions", condition_values(c)},
          {"text", c.scene.text}};
}

Trade trade_of(const Side& native) {
  const Trajectory& t = native.trajectory;
  Trade trade;
  trade.contact_force = native.metrics.mean_force;
  const auto &time = t.column("t"), &x = t.column("rotor_x"), &y = t.column("rotor_y");
  const double from = (1.0 - kSettledShare) * t.end;
  const bool driven = t.has("control_x");
  double square = 0.0;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < from) continue;
    trade.orbit = std::max(trade.orbit, std::hypot(x[i], y[i]));
    if (driven)
      square += std::pow(t.column("control_x")[i], 2) + std::pow(t.column("control_y")[i], 2);
    ++rows;
  }
  if (rows > 0) trade.actuator_force = std::sqrt(square / static_cast<double>(rows));
  return trade;
}

json trade_data(const std::vector<const SceneComparison*>& scenes) {
  if (scenes.size() < 2) return nullptr;
  return list_of(scenes, [](const SceneComparison* scene) -> json {
    const Trade trade = trade_of(scene->native);
    return {{"name", scene->scene.name},
            {"orbit", rounded(kMilli * trade.orbit, 5)},
            {"contact", rounded(trade.contact_force, 5)},
            {"actuator", rounded(trade.actuator_force, 5)}};
  });
}

}  // namespace rotorub
