// The data of a scene's plots, thinned, as report.js reads it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// A part of the run that the page can zoom to, with data of its own resolution.
struct Window {
  std::string name;
  double from = 0.0, to = 0.0;  // s
};

// The whole run; the first contact (a tenth of a turn before to one turn after the first touch of
// any run); the last two turns. Without a contact the whole and the end alone.
std::vector<Window> plot_windows(const SceneComparison& comparison);

// What a plot is drawn over, and how report.js draws it: a series over time; each impact a point, over time or on a
// law; a path on the characteristic of what drives the run; the place over the last turns.
enum class PlotOver { kTime, kImpacts, kLaw, kPath, kTurns };
const char* to_string(PlotOver over);  // "time", "impacts", "law", "path", "turns"

struct PlotKind {
  const char* key;
  const char* title;
  const char* unit;
  const char* text;   // what is to be seen, half a sentence
  const char* shape;  // class in the page: "", "wide", "square"
  PlotOver over = PlotOver::kTime;
  // Whether there is data for it; null: always, or of a series where it has values.
  bool (*shown)(const scene::Scene& scene, const Trajectory& trajectory) = nullptr;
};
// Those that the scene has data for.
std::vector<PlotKind> plot_kinds(const SceneComparison& comparison);

inline constexpr std::size_t kPlotBuckets = 600;  // of a series in a window: 1200 points

nlohmann::json plot_data(const SceneComparison& comparison);

}  // namespace rotorub
