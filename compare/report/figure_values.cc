#include "compare/report/figure_values.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/figures/figure.h"
#include "compare/report/page_values.h"

namespace rotorub {
namespace {

using nlohmann::json;

// The cells of one figure, with the label of its deviation.
json cells_of(const SceneComparison& c, std::size_t figure) {
  json cells = json::array();
  const Figure& f = figures()[figure];
  for (const PageColumn& column : page_columns(c)) {
    json cell = {{"value", figure_value(f, f.value(column.side->metrics))}, {"deviation", ""}};
    const JudgedFigure* compared = column.figures.empty() ? nullptr : &column.figures[figure];
    if (compared && !compared->is_absent()) {
      const JudgedFigure& d = *compared;
      cell["deviation"] = difference_text(d);
      cell["tone"] = column.judged ? tone_class(tone_of(d.verdict)) : "";
      cell["verdict"] = column.judged ? to_string(d.verdict) : "the step's";
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace

const char* tone_class(Tone tone) {
  constexpr const char* kClasses[] = {"", "good", "part", "bad"};  // in the order of Tone
  return kClasses[static_cast<int>(tone)];
}

json column_values(const SceneComparison& c) {
  json all = json::array();
  for (const PageColumn& column : page_columns(c)) {
    all.push_back({{"label", column.side->label},
                   {"settled", to_string(column.side->metrics.settled.attractor)}});
  }
  return all;
}

json figure_rows(const SceneComparison& c, bool judged_only) {
  json rows = json::array();
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    if (judged_only && !f.is_judged()) continue;
    if (is_absent(c, f)) continue;
    rows.push_back(
        {{"label", f.label}, {"unit", f.unit}, {"meaning", f.meaning}, {"cells", cells_of(c, k)}});
  }
  return rows;
}

json split_rows(const SceneComparison& c, bool valid) {
  json rows = json::array();
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    if (!f.split || is_absent(c, f)) continue;
    for (const ComparedModel& m : c.models) {
      const FigureDifference& d = m.figures[k];
      if (d.split.valid != valid) continue;
      rows.push_back({{"label", f.label},
                      {"unit", f.unit},
                      {"side", m.run.label},
                      {"difference", figure_value(f, d.split.difference)},
                      {"model_gap", figure_value(f, d.split.model_gap)},
                      {"step_error", figure_value(f, d.split.step_error)},
                      {"native_step_error", figure_value(f, d.split.native_step_error)},
                      {"floor", size_text(d, d.interval)},
                      {"tone", valid ? "" : "unsure"},
                      {"note", valid ? fmt::format("± {}", figure_value(f, d.split.uncertainty))
                                     : d.split.reason}});
    }
  }
  return rows;
}

json residual_rows(const SceneComparison& c) {
  json rows = json::array();
  for (const ResidualFigure& row : residual_figures()) {
    json cells = json::array();
    for (const PageColumn& column : page_columns(c)) {
      cells.push_back(fmt::format("{:.1e}", column.side->metrics.residuals.*row.value));
    }
    rows.push_back({{"label", row.law}, {"meaning", row.meaning}, {"cells", cells}});
  }
  return rows;
}

json cost_rows(const SceneComparison& c) {
  json speed = json::array(), spread = json::array(), steps = json::array(), factor = json::array();
  for (const PageColumn& column : page_columns(c)) {
    const Side& side = *column.side;
    const Timing& t = side.timing;
    const bool timed = !t.us_per_step.empty();
    speed.push_back(timed ? fmt::format("{:.3g}", t.median) : std::string("–"));
    spread.push_back(timed ? fmt::format("{:.2g} – {:.2g}", t.lowest, t.highest)
                           : std::string("–"));
    steps.push_back(fmt::format("{}", side.trajectory.steps));
    const double wall = 1e-6 * t.median * static_cast<double>(side.trajectory.steps);
    factor.push_back(wall > 0.0 ? fmt::format("{:.3g}", side.trajectory.end / wall)
                                : std::string("–"));
  }
  return json::array({
      {{"label", "time of a step"},
       {"unit", "µs"},
       {"cells", speed},
       {"meaning", "Median of repeated runs that record nothing, engines taken in turn."}},
      {{"label", "its spread"},
       {"unit", "µs"},
       {"cells", spread},
       {"meaning", "Fastest and slowest of them."}},
      {{"label", "steps"},
       {"unit", ""},
       {"cells", steps},
       {"meaning", "Of the run that is shown."}},
      {{"label", "real-time factor"},
       {"unit", ""},
       {"cells", factor},
       {"meaning", "Simulated time over computing time; above 1: faster than the machine."}},
  });
}

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

}  // namespace rotorub
