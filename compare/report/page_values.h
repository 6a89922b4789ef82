// The report template's values for one scene, as rounded texts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The columns of the page's tables: native, its shadow if there is one, and MuJoCo.
struct PageColumn {
  const Side* side = nullptr;
  // One per figure, compared with native, in the order of figures(); empty for native itself.
  std::vector<JudgedFigure> figures;
  bool judged = false;  // whether its differences have verdicts
};
std::vector<PageColumn> page_columns(const SceneComparison& comparison);

// All values except films, plots and the scene's number.
nlohmann::json scene_values(const SceneComparison& comparison);

// The trade-off of control: contact force and actuator force against the rotor's orbit, over the
// native run's last fifth (kSettledShare). A force is 0 if the scene is never in contact, or has no
// actuator.
struct Trade {
  double orbit = 0.0;  // m, largest distance of the rotor from the bearing's axis
  // N, mean normal force from first touch, including the impulses of impacts.
  double contact_force = 0.0;
  double actuator_force = 0.0;  // N, rms of the force on the ring
};
Trade trade_of(const Side& native);

// One point per scene in the given order; null for fewer than two scenes.
nlohmann::json trade_data(const std::vector<const SceneComparison*>& scenes);

}  // namespace rotorub
