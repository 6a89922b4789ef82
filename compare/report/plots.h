// What a scene's plots and its player show, as the page's scripts read it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/report/shown_runs.h"

namespace rotorub {

// A part of the run that the page can zoom to.
struct Window {
  std::string name;
  double from = 0.0, to = 0.0;  // s
};

// The whole run; the first contact (a tenth of a turn before to one turn after the first touch of
// any run); the last two turns. Without a contact the whole and the end alone.
std::vector<Window> plot_windows(const ShownRuns& shown);

// What a plot is drawn over, and how plots.js draws it: a series over time; each impact a point,
// over time or on a law; a path on the characteristic of what drives the run; the place over the
// last turns; whirl, which no window changes.
enum class PlotOver { kTime, kImpacts, kLaw, kPath, kTurns, kWhirl };
const char* to_string(PlotOver over);  // "time", "impacts", "law", "path", "turns", "whirl"

struct PlotKind {
  const char* key;
  const char* title;
  const char* unit;
  const char* text;   // what is to be seen, half a sentence
  const char* shape;  // class in the page: "", "wide", "square"
  PlotOver over = PlotOver::kTime;
  // Whether there is data for it; null: always.
  bool (*shown)(const ShownRuns& shown, const Trajectory& trajectory) = nullptr;
};
// Those that a run has data for.
std::vector<PlotKind> plot_kinds(const ShownRuns& shown);

inline constexpr std::size_t kPlotBuckets = 600;  // of a run's impacts: 1200 points

// For the scripts: windows, runs as tracks (pack/packed_run.h), impacts on their laws, the drawn
// rig.
nlohmann::json plot_data(const ShownRuns& shown);
// For the templates: {{plots}}, {{windows}} and {{legend}} of plots.html.
nlohmann::json plot_values(const ShownRuns& shown);
nlohmann::json window_values(const ShownRuns& shown);
// {{legend}}: of every run that is drawn, its label.
nlohmann::json legend_values(const ShownRuns& shown);

}  // namespace rotorub
