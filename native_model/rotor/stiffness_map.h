// The critical speed map: undamped critical speeds over the stiffness of the bearings, as API 684
// asks for it. Soft bearings: a nearly rigid rotor bounces and rocks; stiff ones: the shaft bends
// between nodes at them.
#pragma once

#include <optional>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub {

struct StiffnessMap {
  std::vector<double> stiffness;  // N/m, ascending, of the first bearing that has any, in x
  double own = 0.0;               // N/m, what the scene gives it
  // rad/s, ascending, at each stiffness (campbell.h: critical_speeds); none where they cannot be
  // found.
  std::vector<std::vector<double>> critical;
};

// The springs of all bearings of the shaft in proportion, from a thousandth to a thousand times
// their own. Empty: the modal form, no bearing with a spring, springs that follow the speed.
std::optional<StiffnessMap> stiffness_map(const scene::Scene& scene);

}  // namespace rotorub
