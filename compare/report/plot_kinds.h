// The kinds of plots of a scene's runs in a page; each is one row in plot_kinds.cc.
#pragma once

#include <cstddef>
#include <vector>

#include "compare/report/plots.h"

namespace rotorub {

// Whether there is one plot for the whole run, or one for each contact if there are several.
enum class PlotOf { kRun, kContact };

struct PlotKind {
  const char* key;
  const char* title;
  const char* unit;
  const char* text;   // half a sentence on what it shows
  const char* shape;  // class in the page: "", "wide", "square"
  // Its abscissa, which selects how traces.js draws it. "time": a series; "impacts" and "law": one
  // point per impact, over time or on a law; "path": on the characteristic of what drives the run;
  // "turns": positions over the last turns; "whirl" and "spread": independent of the time window;
  // "runup": over the spin speed.
  const char* over;
  PlotOf of;
  // Whether there is data for it at this contact.
  bool (*shown)(const ShownRuns& shown, const Trajectory& trajectory, std::size_t contact);
};
struct ShownPlot {
  const PlotKind* kind;
  std::size_t contact;
};
// The plots for which a run has data.
std::vector<ShownPlot> plot_kinds(const ShownRuns& shown);

}  // namespace rotorub
