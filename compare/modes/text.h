// What `rotorub modes` says of a rotor as JSON (public contract) and as text: whirl at given spin
// speeds, critical speeds, the threshold of stability, mode shapes. No contact, small deflections.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/modes/rotor_analysis.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// {"speeds": [{"speed", "modes": [{"frequency", "damping_ratio"}]}], "critical_speeds": [],
// "stability_threshold": null, "stability_bound"}: rad/s; forward whirl positive, backward
// negative; modes by rising absolute frequency. No threshold up to the bound: null; a bound of
// null: nothing can grow at any speed.
//
// And "torsion": [{"frequency", "damping_ratio"}], "mode_shapes": {"z": m, "stations": [{"kind",
// "name", "z"}], "same_planes", "x", "y": [{"frequency": rad/s at rest, undamped, "shape": along z,
// "at_stations"}]}; modes scaled as the coordinates of a run are (mode_shapes.h). Modal form:
// "mode_shapes" is null. With a [contact] each speed has "response": {"orbit": m or null, how far
// the free rotor's centre goes from the ring's under unbalance, weight and forces
// (system/steady_orbit.h), "least_gap": m, < 0 where it would touch, or null, "refused": why there
// is no such orbit, or null}, and "rub": rub_analysis.h; where its rubs cannot be analysed it is
// null, and "rub_refused" says why.
nlohmann::json modes_json(const RotorAnalysis& analysis);

// The same for people, with Hz and rpm; ends with a line break. Of the shapes, the values at the
// stations, of the first modes.
std::string modes_table(const std::string& name, const RotorAnalysis& analysis);

// "disc", "bearing", "contact", "drive", "magnetic_bearing", "force".
const char* to_string(StationKind kind);

}  // namespace rotorub
