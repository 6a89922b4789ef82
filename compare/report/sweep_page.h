// The page of `rotorub sweep`: one HTML file with everything in it. Maps of any two varied keys:
// cells for a grid, marks for other points; for one key a curve.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub {

// What the page of a sweep leads to: the runs of single points.
struct PointRuns {
  std::string command;  // that runs a point, but for the number of it; for a shell
  std::map<std::int64_t, std::string> kept;  // link to the page of each run that was kept
};

// The store holds all points; kept: sweep_json of the same; bifurcation: bifurcation_data
// (bifurcation_plot.h), null: none.
std::string sweep_page(const sweep::PointScenes& scenes, sweep::Store& store,
                       const sweep::Study& study, const nlohmann::json& kept,
                       const PointRuns& runs = {}, const nlohmann::json& bifurcation = nullptr);

// A unit as the page writes it: of rad/s Hz.
struct ShownUnit {
  std::string name;
  double per_si = 1.0;
};
ShownUnit shown_unit(std::string_view unit);

// The same for a report that shows it too (beside.h): "name", "cards", "maps" of the template and
// "plots".
nlohmann::json sweep_json(const sweep::PointScenes& scenes, sweep::Store& store,
                          const sweep::Study& study);

// A browser draws so many; of more, every n-th is taken, and marks stand for the cells.
inline constexpr std::int64_t kMostDrawn = 50'000;

// What the page's script draws: "kind" (grid, marks), "keys" and "figures" (name, unit, ...),
// "values" (a list for each key: places in its values, or numbers), "columns" (a list for each
// figure), "status" (places in "statuses").
nlohmann::json sweep_plots(const sweep::PointScenes& scenes, sweep::Store& store,
                           const sweep::Study& study);

}  // namespace rotorub
