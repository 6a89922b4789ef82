// The plots of the free rotor beside the Campbell diagram: its response to unbalance over the speed
// (Bode and polar plots), and its critical speeds over the stiffness of the supports.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "native_model/linear/stiffness_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// {"speed": [rpm], "running": rpm, "forces": as in SynchronousResponse, "clearance": um, the
// smallest of all contacts, or null, "clearance_of": words for it, "limit": [um] that API 617
// permits with controlled magnetic bearings, or null, "curves": [{"name", "plane": "x", "y", or ""
// with isotropic planes, "amplitude": [um], "phase": [deg], "peaks": [{"speed", "amplitude",
// "phase", "factor": AF, or null, "margin": the separation that API 617 requires, as a share of the
// scene's speed, or null}]}]} up to top (rad/s). The phase continues beyond half a turn; values
// without a steady response are null. The result is null if nothing rotates with the spin.
nlohmann::json bode_data(const scene::Scene& scene, double top);

// For each critical speed map (stiffness_map.h): {"title", "words": how to read it, "stiffness":
// [N/m], "own": N/m, "of": words for the axis, "curves": [[rpm] of the k-th critical speed, null if
// there is none], "ring": the same for the ring alone}.
nlohmann::json stiffness_data(const scene::Scene& scene);

}  // namespace rotorub
