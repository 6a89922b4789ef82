// The page of `rotorub modes`: one self-contained HTML file for any browser, without a network. It
// shows the Campbell diagram, damping, mode shapes along the shaft, and the figures as tables.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/modes/rotor_analysis.h"
#include "native_model/linear/campbell.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// rad/s: the end of a diagram that includes the scene's speed and the requested ones, and the
// critical speeds and the stability threshold unless these are much higher.
double campbell_range(const scene::Scene& scene, const RotorAnalysis& analysis);

// The scene's free rotor as shown in the diagram.
struct Campbell {
  RotorAnalysis analysis;
  double range = 0.0;                 // rad/s
  std::vector<WhirlBranch> branches;  // from 0 to `range` in even steps
};
// range: by default campbell_range. progress: as for whirl_branches.
Campbell campbell_of(const scene::Scene& scene, RotorAnalysis analysis,
                     std::optional<double> range = {},
                     const std::function<void(double)>& progress = {});

std::string modes_page(const scene::Scene& scene, const Campbell& campbell);

// The data of the page's script, in Hz, rpm, % and mm: "campbell" {"top", "running", "critical":
// all of them, "threshold": null, "pieces", "torsion", "operating": the modes at the scene's
// speed}, "shapes" (null in modal form) with "modes" at rest and "whirl" at the scene's speed, and
// "bode" (response_plots.h).
nlohmann::json modes_plots(const scene::Scene& scene, const Campbell& campbell);

// The data of a run's plots of its free rotor (page/plot_words.js), with whirl shapes at the
// scene's speed: {"refusal": why} if it has no whirl to show.
nlohmann::json rotor_section(const scene::Scene& scene);

}  // namespace rotorub
