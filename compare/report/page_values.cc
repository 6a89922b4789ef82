#include "compare/report/page_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/palette.h"
#include "compare/base/version.h"
#include "compare/figures/figure.h"
#include "compare/report/figure_values.h"
#include "compare/report/measured_side.h"
#include "compare/report/mode_values.h"
#include "compare/study/answer.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;

const char* tone(Trust trust) {
  const Tone tone = tone_of(trust);
  return tone == Tone::kGood ? "good" : tone == Tone::kBad ? "bad" : "part";
}
const char* mark(Trust trust) {
  switch (trust) {
    case Trust::kYes:
      return "✓";
    case Trust::kAveragesOnly:
      return "≈";
    case Trust::kUndecidable:
      return "?";
    case Trust::kNo:
      break;
  }
  return "✗";
}

json side_values(const SceneComparison& c) {
  json sides = json::array();
  for (std::size_t k = 0; k < c.sides.size(); ++k) {
    sides.push_back({{"label", c.sides[k].label},
                     {"other", k > 0},
                     {"settled", to_string(c.sides[k].metrics.settled.attractor)}});
  }
  return sides;
}

json verdict_values(const SceneComparison& c) {
  json all = json::array();
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    const SideDifference& d = c.differences[k];
    all.push_back({{"tone", tone(d.trust)},
                   {"mark", mark(d.trust)},
                   {"headline", headline(c, c.sides[k + 1], d)},
                   {"has_reasons", !d.reasons.empty()},
                   {"reasons", d.reasons}});
  }
  return all;
}

json error_values(const LargestError& error) {
  if (!error.figure) return {{"value", "not known"}, {"label", ""}, {"note", ""}};
  return {{"value", deviation_text(*error.figure, error.share)},
          {"label", error.figure->label},
          {"note", error.untold > 0 ? fmt::format("{} not known", error.untold) : std::string()}};
}

// One row a contact model, none smaller than another.
json answer_values(const SceneComparison& c) {
  json rows = json::array();
  std::size_t side = 0;
  for (const AnswerRow& row : answer(c)) {
    const ThreeErrors errors = three_errors(c, ++side);
    rows.push_back({{"errors",
                     {error_values(errors.contact), error_values(errors.step),
                      error_values(errors.modes.value_or(LargestError()))}},
                    {"contact", row.contact},
                    {"question", row.question},
                    {"tone", tone(row.trust)},
                    {"mark", mark(row.trust)},
                    {"trusted", to_string(row.trust)},
                    {"why", row.why},
                    {"cost", row.us_per_step > 0.0 ? fmt::format("{:.3g} µs", row.us_per_step)
                                                   : std::string("–")},
                    {"decides", row.decides},
                    {"evidence", row.evidence}});
  }
  return rows;
}

json impact_rows(const SceneComparison& c) {
  std::vector<std::vector<Impact>> columns;
  std::size_t count = 0;
  for (const SideDifference& d : c.differences) count = std::max(count, d.impacts.size());
  for (const Side& side : c.sides) columns.push_back(first_impacts(side.trajectory, count));
  json rows = json::array();
  for (std::size_t i = 0; i < count; ++i) {
    json cells = json::array();
    for (const auto& column : columns) {
      const bool has = i < column.size();
      cells.push_back(
          {{"time", has ? fmt::format("{:.4f}", 1e3 * column[i].t) : std::string("–")},
           {"impulse", has ? short_number(1e3 * column[i].normal_impulse) : std::string("–")}});
    }
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
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    text += fmt::format("; native and {} {}", c.sides[k + 1].label,
                        part_text(c.differences[k].divergence));
  }
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
  add("twins", fmt::format("{}", c.twins));
  for (const Side& side : c.sides) {
    const Trajectory& t = side.trajectory;
    add(side.label.c_str(), fmt::format("{}, integrator {}, contact {}, {}", t.engine, t.integrator,
                                        t.contact_model, to_string(t.status)));
  }
  return rows;
}

}  // namespace

json scene_values(const SceneComparison& c) {
  const json impacts = impact_rows(c);
  const json resync = resync_rows(c);
  const json ladder = ladder_values(c);
  const json measured = measured_values(c.measured);
  return {{"name", c.scene.name},
          {"has_measured", !measured.is_null()},
          {"measured", measured.is_null() ? json::array() : json::array({measured})},
          {"mode_note", mode_note(c)},
          {"own_notes", own_notes(c)},
          {"by_figures", c.mode != CompareMode::kResync},
          {"resyncs", c.mode == CompareMode::kResync},
          {"resync", resync},
          {"shortest_flight", kShortestFlight},
          {"columns", column_values(c)},
          {"shadow", shadow_sentence(c)},
          {"answer", answer_values(c)},
          {"whose", whose_verdict(c)},
          {"step", time_text(c.scene.run.step)},
          {"end", time_text(c.scene.run.end)},
          {"hash", scene::scene_hash(c.scene)},
          {"sides", side_values(c)},
          {"verdicts", verdict_values(c)},
          {"judged", figure_rows(c, true)},
          {"all", figure_rows(c, false)},
          {"splits", split_rows(c)},
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

}  // namespace rotorub
