// The results of a sweep as the page of `rotorub sweep` shows them: maps of any two varied keys
// (cells for a grid, marks for other points), or a curve for one key; and the bifurcation diagram.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "compare/sweep/bifurcation.h"
#include "compare/sweep/motion_branches.h"
#include "compare/sweep/sample.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

// The values of the sweep, sweep.json, also for a report that shows it (report/beside.h): "name",
// "answer" (sentences of sweep/answer.h), "plots" with "linear" (rub_columns of rub_map_text.h) if
// there is a linear map, and "linear_refused", the reason if there is none.
nlohmann::json sweep_json(const PointScenes& scenes, Store& store, const Study& study);

// The bifurcation diagram (sweep/bifurcation.h) as its file and the page have it:
// {"key": {"name", "unit", "log"}, "up", "down": [{"value": in the key's unit, "refused",
// "continued", "x": [um], "y": [um], "period": turns, "exponent": 1/s or null}], "note": a sentence
// on where the values start, and on the branches}. A periodic motion has the places of one period.
// "branches": null without `branches`, else {"refused": the reason if there is none, or null,
// "lines": [{"order", "starts", "ends", "points": [{"value", "point", "kind", "stable",
// "multiplier", "x": [um], "y": [um]}]}]} as in rub_branches (modes/rub_branches_text.h).
nlohmann::json bifurcation_data(const Study& study, const Sample& sample,
                                const Bifurcation& diagram,
                                const std::optional<MotionBranches>& branches = {});

// Largest number of points for a browser; with more, every n-th is shown, and marks replace the
// cells.
inline constexpr std::int64_t kMostDrawn = 50'000;

// The data of page/maps.js: "kind" (grid, marks), "keys" and "figures" (name, unit, ...),
// "values" of marks (one list per key), "columns" (one list per figure), "status" (indices in
// "statuses"). The points of a grid are in order, with the last key varying fastest.
nlohmann::json sweep_plots(const PointScenes& scenes, Store& store, const Study& study);

// The data of the page. store: must hold all points. kept: sweep_json of the same. runs:
// {"command": shell command that runs a point, without the point's number, "kept": {point: link to
// the page of its saved run}, "points": their number}. bifurcation: bifurcation_data, or null.
nlohmann::json page_data(const PointScenes& scenes, Store& store, const Study& study,
                         const nlohmann::json& kept, const nlohmann::json& runs,
                         const nlohmann::json& bifurcation);

}  // namespace rotorub::sweep
