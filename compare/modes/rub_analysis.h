// What `rotorub modes` says of rotor and ring together: whirl apart and joined, and the lasting
// rubs at a spin speed and the scene's friction. Of the modes kept.
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
  // Of each of its rubs, with torsion and the spin free; empty: both are held.
  std::vector<rub::Stability> driven;
  std::vector<rub::DrivenRolling> rolling;  // at the speeds that the motor keeps, not the one here
  std::vector<WhirlMode> ring;              // alone; a fixed ring: none
  std::vector<WhirlMode> joined;  // rotor centre held to the ring's, as in rolling contact
  std::string left_out;           // of the scene, as a sentence; empty: nothing
};

struct RubAnalyses {
  std::vector<RubAnalysis> at;  // one for each speed; none where refused
  std::string refused;          // why there are none; empty: there is no [contact]
  std::string contact;          // its name, where there are several
};

// Of each contact while the others are open. Loads keep their ratio to the spin (rub::at_speed). A
// scene whose rubs cannot be analysed is no error here.
std::vector<RubAnalyses> analyse_rubs(const scene::Scene& scene, const std::vector<double>& speeds);

// [{"frequency": rad/s, "damping_ratio"}], as of every spectrum.
nlohmann::json whirls_json(const std::vector<WhirlMode>& modes);

// "no contact", "synchronous rub", "backward whip", "rolling", joined by " + "; "none stable". The
// words of a sweep's attractors.
std::string attractors_text(unsigned attractors);

// {"free_orbit": m or null, "free_growth_rate": 1/s, "attractors": [], "rubs": [{"kind" (forced,
// whip, rolling), "whirl": rad/s, "normal_force": N, "friction", "slip": m/s, "stable",
// "growth_rate": 1/s, "frequency": rad/s, of the least stable pair in the frame that turns with the
// rub}], "rolling_ranges":
// [[rad/s, rad/s or null]]}, with "speed" and "friction" (a number, or where it depends on the slip
// {"static", "kinetic", "stribeck_speed", "viscous"}).
nlohmann::json rub_point_json(const rub::RubPoint& point);
// The same with "left_out" (a sentence, or null), "ring" and "joined": [{"frequency",
// "damping_ratio"}]. With torsion, or a [drive]
// whose torque depends on the speed alone, also "driven": [{"growth_rate", "frequency", "stable"}],
// the rubs where these give way, and "driven_rolling": [{"speed": rad/s, "torque": N m, "whirl",
// "normal_force", "friction", "growth_rate", "frequency", "stable"}].
nlohmann::json rub_json(const RubAnalysis& analysis);

// For people; each ends with a line break.
std::string rub_table(const RubAnalysis& analysis);

}  // namespace rotorub
