// The characteristic curves of actuator and motor, which a run's own points are drawn on (paper,
// Figs. 3 and 6).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "native_model/scene/scene.h"

namespace rotorub {

// F(s, i) of an axis of a bearing over its current, N over A, at five places of the ring: [{"name",
// "x", "y"}]; empty without magnets.
nlohmann::json actuator_curves(const scene::Scene& scene, std::size_t bearing);

// The motor's torque over its speed between two speeds (rad/s), N m over rpm: {"x", "y"}; null
// where it is no function of the speed alone, or there is none.
nlohmann::json motor_curve(const scene::Scene& scene, double from, double to);

}  // namespace rotorub
