// The controller's command, from the law that the native model uses, written to ctrl.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "native_model/system/actuation.h"
#include "plugin/config.h"
#include "plugin/coordinates.h"

namespace rotorub::plugin {

// Held between the samples k T of a sampled controller. Leaves the user's ctrl alone where the
// scene has no active controller.
void write_command(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// The law failed: mju_error with its word, which names the time; the data tell it too
// (kContactStatus).
void controller_failed(mjData* d, const std::string& why);

// Force of the actuators on the ring, of the forward pass done last, and the currents now.
ActuatorState actuator_state(const Config& config, const mjModel* m, const mjData* d);

// What the actuators were commanded in the forward pass done last, as control_command has it: the
// force on the ring, N, fixed frame, or with magnets the currents of the two axes, A. Without lag
// it is what acted: with native steps the mean about the pass's instant.
Eigen::Vector2d command_of_pass(const Config& config, const mjModel* m, const mjData* d);

}  // namespace rotorub::plugin
