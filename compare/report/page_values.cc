#include "compare/report/page_values.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report/mode_values.h"
#include "compare/study/answer.h"
#include "compare/study/format.h"
#include "compare/study/verdict.h"
#include "compare/version.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;

const char* tone(Trust trust) {
  return trust == Trust::kYes ? "good" : trust == Trust::kNo ? "bad" : "part";
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

const char* tone(FigureVerdict verdict) {
  switch (verdict) {
    case FigureVerdict::kWithin:
      return "good";
    case FigureVerdict::kOutside:
      return "bad";
    case FigureVerdict::kUndecidable:
      return "part";
    case FigureVerdict::kNotJudged:
      break;
  }
  return "";
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

json column_values(const SceneComparison& c) {
  json all = json::array();
  for (const PageColumn& column : page_columns(c)) {
    all.push_back({{"label", column.side->label},
                   {"other", !column.figures.empty()},
                   {"settled", to_string(column.side->metrics.settled.attractor)}});
  }
  return all;
}

// Value cells of one figure, with the chip of its deviation.
json cells_of(const SceneComparison& c, std::size_t figure) {
  json cells = json::array();
  const Figure& f = figures()[figure];
  for (const PageColumn& column : page_columns(c)) {
    json cell = {{"value", figure_value(f, f.value(column.side->metrics))},
                 {"other", !column.figures.empty()}};
    if (!column.figures.empty()) {
      const JudgedFigure& d = column.figures[figure];
      cell["deviation"] = deviation_text(f, d.deviation);
      cell["tone"] = column.judged ? tone(d.verdict) : "";
      cell["verdict"] = column.judged ? to_string(d.verdict) : "the step's";
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

json figure_rows(const SceneComparison& c, bool judged_only) {
  json rows = json::array();
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    if (judged_only && !f.is_judged()) continue;
    rows.push_back(
        {{"label", f.label}, {"unit", f.unit}, {"meaning", f.meaning}, {"cells", cells_of(c, k)}});
  }
  return rows;
}

// One row a contact model, none smaller than another.
json answer_values(const SceneComparison& c) {
  json rows = json::array();
  for (const AnswerRow& row : answer(c)) {
    rows.push_back({{"contact", row.contact},
                    {"tone", tone(row.trust)},
                    {"mark", mark(row.trust)},
                    {"trusted", to_string(row.trust)},
                    {"why", row.why},
                    {"cost", row.us_per_step > 0.0 ? fmt::format("{:.3g} µs", row.us_per_step)
                                                   : std::string("–")},
                    {"decides", row.decides}});
  }
  return rows;
}

json split_rows(const SceneComparison& c) {
  json rows = json::array();
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    if (!f.split) continue;
    for (std::size_t side = 1; side < c.sides.size(); ++side) {
      const FigureDifference& d = c.differences[side - 1].figures[k];
      rows.push_back(
          {{"label", f.label},
           {"unit", f.unit},
           {"side", c.sides[side].label},
           {"difference", figure_value(f, d.split.difference)},
           {"model_gap", figure_value(f, d.split.model_gap)},
           {"step_error", figure_value(f, d.split.step_error)},
           {"native_step_error", figure_value(f, d.split.native_step_error)},
           {"floor", size_text(f, d.spread)},
           {"tone", d.split.valid ? "" : "unsure"},
           {"note", d.split.valid ? fmt::format("valid, ± {}", figure_value(f, d.split.uncertainty))
                                  : "not valid: " + d.split.reason}});
    }
  }
  return rows;
}

struct ResidualRow {
  const char* label;
  const char* meaning;
  double Residuals::*value;
};
constexpr ResidualRow kResidualRows[] = {
    {"law g ≥ 0", "Deepest penetration in a recorded row, over the clearance.",
     &Residuals::penetration},
    {"law λ ≥ 0", "Largest pull (a contact cannot pull), over the mean force in contact.",
     &Residuals::adhesion},
    {"law g λ = 0", "Largest product of open gap and force: force without touch.",
     &Residuals::complementarity},
    {"friction cone", "Friction beyond mu times the normal force.", &Residuals::cone},
    {"sliding law", "While sliding: distance of the friction from -mu λ sign(slip).",
     &Residuals::sliding},
    {"friction brakes", "Friction power above 0: friction that drives.", &Residuals::power},
    {"series itself", "Recorded gap against the gap of the recorded positions.",
     &Residuals::gap_error},
};

json residual_rows(const SceneComparison& c) {
  json rows = json::array();
  for (const ResidualRow& row : kResidualRows) {
    json cells = json::array();
    for (const PageColumn& column : page_columns(c)) {
      cells.push_back(fmt::format("{:.1e}", column.side->metrics.residuals.*row.value));
    }
    rows.push_back({{"label", row.label}, {"meaning", row.meaning}, {"cells", cells}});
  }
  return rows;
}

json cost_rows(const SceneComparison& c) {
  json speed = json::array(), spread = json::array(), steps = json::array(), factor = json::array();
  for (const PageColumn& column : page_columns(c)) {
    const Side& side = *column.side;
    const Timing& t = side.timing;
    const bool timed = !t.us_per_step.empty();
    speed.push_back(timed ? fmt::format("{:.3g} µs", t.median) : std::string("–"));
    spread.push_back(timed ? fmt::format("{:.3g} – {:.3g} µs", t.lowest, t.highest)
                           : std::string("–"));
    steps.push_back(fmt::format("{}", side.trajectory.steps));
    const double wall = 1e-6 * t.median * static_cast<double>(side.trajectory.steps);
    factor.push_back(wall > 0.0 ? fmt::format("{:.3g}", side.trajectory.end / wall)
                                : std::string("–"));
  }
  return json::array({
      {{"label", "time of a step"},
       {"cells", speed},
       {"meaning", "Median of repeated runs that record nothing, engines taken in turn."}},
      {{"label", "its spread"}, {"cells", spread}, {"meaning", "Fastest and slowest of them."}},
      {{"label", "steps"}, {"cells", steps}, {"meaning", "Of the run that is shown."}},
      {{"label", "real-time factor"},
       {"cells", factor},
       {"meaning", "Simulated time over computing time; above 1: faster than the machine."}},
  });
}

// Null where there is no ladder to show.
json ladder_values(const SceneComparison& c) {
  if (!c.model_error || !c.model_error->reason.empty()) return nullptr;
  json rungs = json::array(), rows = json::array();
  for (const int n : c.model_error->modes) rungs.push_back(fmt::format("{} modes", n));
  for (const FigureLimit& f : c.model_error->figures) {
    json cells = json::array();
    for (const double v : f.values) cells.push_back(figure_value(*f.figure, v));
    const bool seen = f.error.has_value();
    rows.push_back({{"label", f.figure->label},
                    {"unit", f.figure->unit},
                    {"cells", cells},
                    {"convergence", to_string(f.convergence)},
                    {"tone", seen ? "" : "unsure"},
                    {"off", seen ? deviation_text(*f.figure, *f.error) : std::string("–")},
                    {"left", seen ? size_text(*f.figure, std::abs(*f.left)) : std::string("–")}});
  }
  return {{"rungs", rungs}, {"rows", rows}};
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
  return {{"name", c.scene.name},
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
