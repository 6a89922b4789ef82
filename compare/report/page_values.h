// What the report's template shows of one scene: texts, already worded and rounded.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The columns of the page's tables: native, its shadow where there is one, MuJoCo's.
struct PageColumn {
  const Side* side = nullptr;
  // Of each figure against native: as figures(); empty for native itself.
  std::vector<JudgedFigure> figures;
  bool judged = false;  // its differences carry verdicts
};
std::vector<PageColumn> page_columns(const SceneComparison& comparison);

// Everything but films, plots and the scene's number.
nlohmann::json scene_values(const SceneComparison& comparison);

// What control trades: contact force and actuator force against the rotor's orbit. Of the native
// run's last fifth (kSettledShare); forces of a scene that is never in contact, or has no actuator,
// are 0.
struct Trade {
  double orbit = 0.0;           // m, largest distance of the rotor from the bearing's axis
  double contact_force = 0.0;   // N, mean normal from first touch, impulses of impacts with it
  double actuator_force = 0.0;  // N, rms of the force on the ring
};
Trade trade_of(const Side& native);

// One point a scene, in the order given; null for fewer than two, which trade nothing.
nlohmann::json trade_data(const std::vector<const SceneComparison*>& scenes);

}  // namespace rotorub
