// What the joints and tendons of the segment rotor do not have by themselves, as passive forces:
// external and rotating damping of its modes, forces, magnetic bearing, drive, weight of the ring.
// Springs, bearings, gyroscopics, unbalance and the rotor's weight are MuJoCo's own.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

// Adds to d->qfrc_passive. The config is that of a segment rotor.
void add_segment_loads(const Config& config, mjData* d);

}  // namespace rotorub::plugin
