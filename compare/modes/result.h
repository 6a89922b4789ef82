// The result of `rotorub modes`: the analysis of a rotor and of its lasting rubs.
#pragma once

#include <string>

#include "compare/modes/rotor_analysis.h"
#include "compare/modes/rub_analysis.h"
#include "compare/result/result.h"

namespace rotorub {

// As JSON (public contract): {"speeds": [{"speed", "modes": [{"frequency", "damping_ratio"}]}],
// "critical_speeds": [], "critical": [{"speed", "whirl": "forward", "backward" or "planar"}],
// "stability_threshold": null, "unstable_ranges": [[from, to]], "stability_bound"}: rad/s; forward
// whirl positive, backward negative; modes by rising absolute frequency. The threshold is null if
// there is none up to the bound; the bound is null if nothing can grow at any speed; `to` is null
// if a whirl still grows at the bound.
//
// And "torsion": [{"frequency", "damping_ratio"}], "mode_shapes": {"z": m, "stations": [{"kind",
// "name", "z"}], "same_planes", "x", "y": [{"frequency": rad/s at rest, undamped, "shape": along z,
// "at_stations"}]}; modes are scaled like the coordinates of a run (mode_shapes.h). In modal form
// "mode_shapes" is null. With a [contact] each speed has "response" (response_text.h) and "rub"
// (rub_result) of the first contact; if its rubs cannot be analysed, "rub" is null and
// "rub_refused" gives the reason. With several contacts "contacts" holds the same keys and "name"
// for each. "notes": sentences on where the response is not valid. "levitation": levitation_text.h.
// "periodic_rubs", if they were searched: periodic_rubs_text.h.
//
// People read it in Hz and rpm, with the shapes of the first modes at the stations.
result::Section modes_result(const std::string& name, const RotorAnalysis& analysis);

// A sentence without full stop on the ranges of speed in which a whirl grows.
std::string stability_text(const RotorAnalysis& analysis);

// {"free_orbit": m or null, "free_growth_rate": 1/s, "attractors": [], "rubs": [{"kind" (forced,
// whip, rolling), "whirl": rad/s, "normal_force": N, "friction", "slip": m/s, "ring_speed": rad/s,
// "stable", "growth_rate": 1/s, "frequency": rad/s, of the least stable pair in the frame that
// turns with the rub}], "rolling_ranges": [[rad/s, rad/s or null]]}, with "speed" and "friction" (a
// number, or if it depends on the slip {"static", "kinetic", "stribeck_speed", "viscous"}).
result::Section rub_point_result(const rub::RubPoint& point);
// The same with "left_out" (a sentence, or null), "ring" and "joined": [{"frequency",
// "damping_ratio"}]. With torsion, or a [drive] whose torque depends only on the speed, also
// "driven": [{"growth_rate", "frequency", "stable"}], the rubs with torsion and spin free, and
// "driven_rolling": [{"speed": rad/s, "torque": N m, "whirl", "normal_force", "friction",
// "growth_rate", "frequency", "stable"}].
result::Section rub_result(const RubAnalysis& analysis);

}  // namespace rotorub
