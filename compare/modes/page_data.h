// The free rotor for report/page/rotor_data.js, in SI units.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
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

// {"running": the scene's speed, "top": end of the diagram, both
// rad/s, "branches": [{"speed", "modes"}], "operating": modes at the scene's speed, "whirl_shapes",
// "shaft": its "sections" and "discs", null in modal form, "response": of synchronous_response.h,
// or null}. A mode is [frequency in rad/s, damping ratio].
nlohmann::json rotor_data(const scene::Scene& scene, const Campbell& campbell);
// The same for a run's free rotor, with "found", the JSON of `rotorub modes`; or {"refusal":
// reason} if it has no whirl to show.
nlohmann::json rotor_data(const scene::Scene& scene);

// The data of the page of `rotorub modes`: "rotor" is rotor_data with "stiffness", the critical
// speed maps (stiffness_map.h): [{"of": "bearings", "magnets", "ring" or "mount", "contact": name
// of the ring among several, "stiffness", "own", "critical", "ring"}]. "loops" has the curves of
// each closed loop of magnetic bearings in the result, one per axis: {"sensitivity": |S| over
// rad/s, "step": m/N over s, until all have settled}.
nlohmann::json modes_data(const scene::Scene& scene, const Campbell& campbell);

}  // namespace rotorub
