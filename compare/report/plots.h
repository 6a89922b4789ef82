// What a page shows of one scene: its runs side by side, whoever made them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/measured/measured_run.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// The pointed to must outlive it.
struct ShownRun {
  std::string label;  // "native", "rigid", "coulomb", "cone", "shadow": its colour in the page
  const Trajectory* trajectory = nullptr;
};

struct ShownRuns {
  const scene::Scene* scene = nullptr;
  std::vector<ShownRun> runs;                // the first two are compared first
  const MeasuredRun* measured = nullptr;     // laid beside them; null: none
  const Trajectory* uncontrolled = nullptr;  // the first run with a passive bearing; null: none
};

ShownRuns shown_runs(const SceneComparison& comparison);
// Of a run's folder, with its shadow where it has one.
ShownRuns shown_runs(const StoredRun& run, const std::optional<StoredRun>& shadow);

// s; nothing where it never touches.
std::optional<double> first_touch(const Trajectory& trajectory);

// What a scene's plots and its player show, as the page's scripts read it.

// A part of the run that the page can zoom to.
struct Window {
  std::string name;
  double from = 0.0, to = 0.0;  // s
};

// The whole run; the first contact (a tenth of a turn before to one turn after the first touch of
// any run); the last two turns. Without a contact the whole and the end alone.
std::vector<Window> plot_windows(const ShownRuns& shown);

// Whether a plot is of the whole run, or of each contact where there are several.
enum class PlotOf { kRun, kContact };

struct PlotKind {
  const char* key;
  const char* title;
  const char* unit;
  const char* text;   // what is to be seen, half a sentence
  const char* shape;  // class in the page: "", "wide", "square"
  // What it is drawn over, and how traces.js draws it: "time", a series; "impacts" and "law", each
  // impact a point, over time or on a law; "path", on the characteristic of what drives the run;
  // "turns", the place over the last turns; "whirl", which no window changes.
  const char* over;
  PlotOf of;
  // Whether there is data for it, at this contact.
  bool (*shown)(const ShownRuns& shown, const Trajectory& trajectory, std::size_t contact);
};
struct ShownPlot {
  const PlotKind* kind;
  std::size_t contact;
};
// Those that a run has data for.
std::vector<ShownPlot> plot_kinds(const ShownRuns& shown);

inline constexpr std::size_t kPlotBuckets = 600;  // of a run's impacts: 1200 points

// For the scripts: windows, runs as tracks (pack/packed_run.h), impacts on their laws, the drawn
// rig.
nlohmann::json plot_data(const ShownRuns& shown);
// For the templates player.html and plots.html: {{plots}}, {{windows}}, {{legend}} of every run
// that is drawn, {{contacts}}, and {{several}} of these.
nlohmann::json live_values(const ShownRuns& shown);

}  // namespace rotorub
