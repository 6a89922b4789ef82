// The rig for the page's player: the machine of the films, with scales common to all runs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "compare/report/plots.h"
#include "native_model/scene/scene.h"
#include "renders/machine.h"

namespace rotorub {

// The machine and its magnification for the first run with rows; empty if no run has rows.
std::optional<renders::Machine> drawn_machine(const ShownRuns& shown);

// {"magnification", ...}: the members of renders::Machine by their names, with lengths in drawing
// units (`unit` per metre). Parts that the scene lacks are null or [].
nlohmann::json rig_values(const scene::Scene& scene, const renders::Machine& machine);

// For each auxiliary bearing, at least one: "name" ("" if it is the only one), "touches",
// "rubs" (with friction), clearance, restitution and radius (m), its drawn parts, and "actuator",
// its characteristic curves.
nlohmann::json contacts_values(const scene::Scene& scene,
                               const std::optional<renders::Machine>& machine);

// The characteristic curves of actuator and motor, on which a run's own points are drawn (paper,
// Figs. 3 and 6).
// F(s, i) of an axis of a bearing over its current, N over A, at five positions of the ring:
// [{"name", "x", "y"}]; empty without magnets.
nlohmann::json actuator_curves(const scene::Scene& scene, std::size_t bearing);
// The motor's torque between two speeds (rad/s), N m over rpm: {"x", "y"}; null without a motor, or
// if the torque does not depend only on the speed.
nlohmann::json motor_curve(const scene::Scene& scene, double from, double to);

}  // namespace rotorub
