// The rig as the page's player draws it: the films' machine, and the scales that all runs share.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "compare/report/plots.h"
#include "native_model/scene/scene.h"
#include "renders/machine.h"

namespace rotorub {

// The machine of the first run that has rows, magnified for that one; nothing where none has.
std::optional<renders::Machine> drawn_machine(const ShownRuns& shown);

// {"magnification", ...}: the members of renders::Machine by their names, lengths in drawing units
// (`unit` of them to a metre). Parts that the scene does not have are null or [].
nlohmann::json rig_values(const scene::Scene& scene, const renders::Machine& machine);

// Of each auxiliary bearing: "name" ("" of the only one), "touches", clearance, restitution and
// radius (m), what is drawn of it, and "actuator", its characteristic curves. One at least.
nlohmann::json contacts_values(const scene::Scene& scene,
                               const std::optional<renders::Machine>& machine);

// The characteristic curves of actuator and motor, which a run's own points are drawn on (paper,
// Figs. 3 and 6).
// F(s, i) of an axis of a bearing over its current, N over A, at five places of the ring: [{"name",
// "x", "y"}]; empty without magnets.
nlohmann::json actuator_curves(const scene::Scene& scene, std::size_t bearing);
// The motor's torque over its speed between two speeds (rad/s), N m over rpm: {"x", "y"}; null
// where it is no function of the speed alone, or there is none.
nlohmann::json motor_curve(const scene::Scene& scene, double from, double to);

}  // namespace rotorub
