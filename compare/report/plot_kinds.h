// Which plots a page has of a scene's runs: a row each (plot_kinds.cc).
#pragma once

#include <cstddef>
#include <vector>

#include "compare/report/plots.h"

namespace rotorub {

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
  // "turns", the place over the last turns; "whirl" and "spread", which no window changes; "runup",
  // over the spin speed.
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

}  // namespace rotorub
