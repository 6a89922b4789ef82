// The rig as the page's player draws it: the films' machine, and the scales that all runs share.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "compare/report/shown_runs.h"
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

}  // namespace rotorub
