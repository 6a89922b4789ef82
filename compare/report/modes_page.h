// The page of `rotorub modes`: one HTML file with everything in it, for any browser, without a
// network. Campbell diagram, damping, mode shapes along the shaft, and the figures as tables.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/modes/rotor_analysis.h"
#include "native_model/rotor/whirl_branches.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// rad/s, the highest spin speed of a diagram that shows the scene's speed, those asked for, the
// critical speeds and the threshold of stability, unless these lie far beyond the others.
double campbell_range(const scene::Scene& scene, const RotorAnalysis& analysis);

inline constexpr int kCampbellSpeeds = 161;
inline constexpr double kCampbellAccuracy = 1e-5;  // relative, of the curves: finer than a line

// branches: from 0 to `range` (rad/s) in even steps, as whirl_branches gives them.
std::string modes_page(const scene::Scene& scene, const RotorAnalysis& analysis, double range,
                       const std::vector<WhirlBranch>& branches);

// What the page's script draws, in Hz, rpm, % and mm: "campbell" {"top", "running", "critical",
// "threshold": null, "pieces"} and "shapes" (null for the modal form).
nlohmann::json modes_plots(const scene::Scene& scene, const RotorAnalysis& analysis, double range,
                           const std::vector<WhirlBranch>& branches);

}  // namespace rotorub
