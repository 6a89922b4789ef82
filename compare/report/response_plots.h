// What the pages draw of the free rotor beside Campbell's diagram: its response to unbalance over
// the speed (Bode, polar), and its critical speeds over the stiffness of what holds it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "native_model/linear/stiffness_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// {"speed": [rpm], "running": rpm, "forces": as SynchronousResponse, "clearance": um, the
// least of all contacts, or null, "clearance_of": words for it, "limit": [um] that API 617 allows
// in magnetic bearings that control, or null, "curves": [{"name", "plane": "x", "y", or "" of
// planes that are alike, "amplitude": [um], "phase": [deg], "peaks": [{"speed", "amplitude",
// "phase", "factor": or null}]}]} up to top (rad/s). The phase goes on beyond half a turn; null
// where there is nothing steady. Null: nothing turns with the spin.
nlohmann::json bode_data(const scene::Scene& scene, double top);

// Rows of the page's table of peaks, from bode_data: of peaks at nearly one speed the largest, its
// station, and how far the scene's speed lies from it beside what API 617 asks for. Texts.
nlohmann::json peak_rows(const nlohmann::json& bode);

// Of each critical speed map (stiffness_map.h): {"stiffness": [N/m], "own": N/m, "of": words for
// the axis, "curves": [[rpm] of the k-th critical speed, null where there is none], "ring": the
// same of the ring alone}.
nlohmann::json stiffness_data(const std::vector<StiffnessMap>& maps);
// For the page's template, as many: {"index", "title", "words": how it is read}.
nlohmann::json stiffness_values(const scene::Scene& scene, const std::vector<StiffnessMap>& maps);

}  // namespace rotorub
