// The page of `rotorub sweep`: one self-contained HTML file with maps of any two varied keys (cells
// for a grid, marks for other points), or a curve for one key.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/sweep/bifurcation.h"
#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub {

// The links from the page of a sweep to the runs of single points.
struct PointRuns {
  std::string command;  // shell command that runs a point, without the point's number
  std::map<std::int64_t, std::string> kept;  // link to the page of each saved run
};

// store: must hold all points. kept: sweep_json of the same. bifurcation: bifurcation_data,
// or null.
std::string sweep_page(const sweep::PointScenes& scenes, sweep::Store& store,
                       const sweep::Study& study, const nlohmann::json& kept,
                       const PointRuns& runs = {}, const nlohmann::json& bifurcation = nullptr);

// The values of the sweep for a report that shows it too (beside.h): "name", "answer" (sentences of
// sweep/answer.h), "plots" with "linear" (rub_columns of linear_maps.h) if there is a linear map,
// and "linear_refused", the reason if there is none.
nlohmann::json sweep_json(const sweep::PointScenes& scenes, sweep::Store& store,
                          const sweep::Study& study);

// The bifurcation diagram (sweep/bifurcation.h) as its file and the page have it:
// {"key": {"name", "unit", "log"}, "up", "down": [{"value": in the key's unit, "refused",
// "continued", "x": [um], "y": [um], "period": turns, "exponent": 1/s or null}], "note": a sentence
// on where the values start}. A periodic motion has the places of one period.
nlohmann::json bifurcation_data(const sweep::Study& study, const sweep::Sample& sample,
                                const sweep::Bifurcation& diagram);

// Largest number of points for a browser; with more, every n-th is shown, and marks replace the
// cells.
inline constexpr std::int64_t kMostDrawn = 50'000;

// The data of page/maps.js: "kind" (grid, marks), "keys" and "figures" (name, unit, ...),
// "values" of marks (one list per key), "columns" (one list per figure), "status" (indices in
// "statuses"). The points of a grid are in order, with the last key varying fastest.
nlohmann::json sweep_plots(const sweep::PointScenes& scenes, sweep::Store& store,
                           const sweep::Study& study);

}  // namespace rotorub
