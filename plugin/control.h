// The controller's command, from the law that the native model uses, written to ctrl.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/coordinates.h"

namespace rotorub::plugin {

// Remembers the first touch: the time of the first forward pass that meets a closed gap.
void note_first_touch(const Config& config, mjData* d, const Coordinates& state);

// Held between the samples k T of a sampled controller. Leaves the user's ctrl alone where the
// scene has no active controller.
void write_command(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// Force of the actuators on the ring, N, fixed frame, of the forward pass done last.
Eigen::Vector2d actuator_force(const Config& config, const mjData* d);

}  // namespace rotorub::plugin
