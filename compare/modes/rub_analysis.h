// Rotor and ring together in `rotorub modes`: their whirl, separate and joined, and the lasting
// rubs at a spin speed with the scene's friction, for the kept modes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/linear/driven_rub.h"
#include "native_model/linear/rub_map.h"
#include "native_model/scene/scene.h"

namespace rotorub {

struct RubAnalysis {
  rub::RubPoint point;
  // Stability of each rub with torsion and the spin free; empty if both are held.
  std::vector<rub::Stability> driven;
  // At the speeds that the motor sustains, not at the speed of `point`.
  std::vector<rub::DrivenRolling> rolling;
  std::vector<WhirlMode> ring;    // of the ring alone; empty for a fixed ring
  std::vector<WhirlMode> joined;  // rotor centre coupled to the ring centre, as in rolling contact
  std::string left_out;  // a sentence on what the analysis leaves out of the scene; may be empty
};

struct RubAnalyses {
  std::vector<RubAnalysis> at;  // one per speed; empty if refused
  std::string refused;          // the reason; empty if not refused, or without a [contact]
  std::string contact;          // its name if there are several
};

// Analyses each contact with the others open. Loads keep their ratio to the spin (rub::at_speed). A
// scene whose rubs cannot be analysed is not an error here.
std::vector<RubAnalyses> analyse_rubs(const scene::Scene& scene, const std::vector<double>& speeds);

// [{"frequency": rad/s, "damping_ratio"}], as in every spectrum.
nlohmann::json whirls_json(const std::vector<WhirlMode>& modes);

// "no contact", "synchronous rub", "backward whip" and "rolling", joined by " + ", or "none
// stable". A sweep uses the same words for its attractors.
std::string attractors_text(unsigned attractors);

// {"free_orbit": m or null, "free_growth_rate": 1/s, "attractors": [], "rubs": [{"kind" (forced,
// whip, rolling), "whirl": rad/s, "normal_force": N, "friction", "slip": m/s, "stable",
// "growth_rate": 1/s, "frequency": rad/s, of the least stable pair in the frame that turns with the
// rub}], "rolling_ranges": [[rad/s, rad/s or null]]}, with "speed" and "friction" (a number, or if
// it depends on the slip {"static", "kinetic", "stribeck_speed", "viscous"}).
nlohmann::json rub_point_json(const rub::RubPoint& point);
// The same with "left_out" (a sentence, or null), "ring" and "joined": [{"frequency",
// "damping_ratio"}]. With torsion, or a [drive] whose torque depends only on the speed, also
// "driven": [{"growth_rate", "frequency", "stable"}], the rubs with torsion and spin free, and
// "driven_rolling": [{"speed": rad/s, "torque": N m, "whirl", "normal_force", "friction",
// "growth_rate", "frequency", "stable"}].
nlohmann::json rub_json(const RubAnalysis& analysis);

// For people; ends with a line break.
std::string rub_table(const RubAnalysis& analysis);

}  // namespace rotorub
