// Rotor and ring together in `rotorub modes`: their whirl, separate and joined, and the lasting
// rubs at a spin speed with the scene's friction, for the kept modes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/metrics/above_modes.h"
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
  std::optional<ModeBand> band;  // of the modes kept at this speed; geometry form only
  // Whether a whirl (rad/s) is faster than the modes kept, so that its force depends on their
  // number.
  bool is_above_modes(double whirl) const { return band && is_above(*band, whirl); }
};

struct RubAnalyses {
  std::vector<RubAnalysis> at;  // one per speed; empty if refused
  std::string refused;          // the reason; empty if not refused, or without a [contact]
  std::string contact;          // its name if there are several
};

// Analyses each contact with the others open. Loads keep their ratio to the spin (rub::at_speed). A
// scene whose rubs cannot be analysed is not an error here.
std::vector<RubAnalyses> analyse_rubs(const scene::Scene& scene, const std::vector<double>& speeds);

// "no contact", "synchronous rub", "backward whip" and "rolling". A sweep uses the same words for
// its attractors.
std::vector<std::string> attractor_names(unsigned attractors);
// The names joined by " + ", or "none stable".
std::string attractors_text(unsigned attractors);

}  // namespace rotorub
