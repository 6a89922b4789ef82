// The distance of the running speed from the nearest critical speed, with the distance that API 617
// requires.
#pragma once

#include <optional>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub {

struct SpeedMargin {
  double speed = 0.0;          // rad/s, absolute value, of the scene
  double critical = 0.0;       // rad/s, the nearest critical speed
  double amplification = 0.0;  // AF of its peak in the response before a loss
  // As a share of `speed`; empty if the peak is critically damped.
  std::optional<double> required;
};

// critical: rad/s, absolute values. Empty if the rotor does not turn, or if the response to
// unbalance has no peak with an amplification factor within 5 % of the nearest critical speed.
std::optional<SpeedMargin> speed_margin(const scene::Scene& scene,
                                        const std::vector<double>& critical);

}  // namespace rotorub
