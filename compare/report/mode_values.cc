#include "compare/report/mode_values.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/figures/figure.h"
#include "compare/study/resync_text.h"

namespace rotorub {

std::vector<PageColumn> page_columns(const SceneComparison& c) {
  std::vector<PageColumn> columns{{&c.sides.front(), {}, false}};
  if (c.shadow.side) columns.push_back({&*c.shadow.side, c.shadow.figures, false});
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    columns.push_back({&c.sides[k + 1], c.differences[k].judged(), true});
  }
  return columns;
}

std::string shadow_sentence(const SceneComparison& c) {
  if (!c.shadow.side) return "No shadow: " + c.shadow.absent;
  const std::string what = fmt::format("Shadow: the native stepper ({}) at MuJoCo's step",
                                       c.shadow.side->trajectory.integrator);
  if (!c.shadow.driven) {
    return what +
           ". What it is off by is the step's; what MuJoCo is off beyond it is the contact "
           "model's.";
  }
  return what + ", driven by the commands of " + c.sides[1].label +
         ". What it is off by is the step's, and what the open loop makes of it.";
}

nlohmann::json resync_rows(const SceneComparison& c) {
  using nlohmann::json;
  json rows = json::array();
  for (std::size_t k = 0; k < c.differences.size(); ++k) {
    if (!c.differences[k].resync) continue;
    const Resync& r = *c.differences[k].resync;
    for (const ResyncRow& row : r.rows) {
      const ResyncFigure& f = *row.figure;
      rows.push_back({{"side", c.sides[k + 1].label},
                      {"onsets", r.onsets.size()},
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
                      {"tone", row.verdict == FigureVerdict::kWithin ? "good" : "bad"},
                      {"verdict", to_string(row.verdict)}});
    }
  }
  return rows;
}

}  // namespace rotorub
