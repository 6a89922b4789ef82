// The magnetic actuator in MuJoCo: two actuators of user gain and bias on the ring's axes. ctrl is
// the current asked for, A; with a coil lag the activation is the coil's current, else ctrl is. The
// force is
//
//   gain i + bias,   bias = F(s, 0),   gain = (F(s, i) - F(s, 0)) / i,
//
// F the law that the native model uses, s the actuator's length.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

// True for an actuator of ours whose force is F(s, i).
bool is_magnet(const Config& config, int actuator);

// Current asked for, within MuJoCo's limits, A.
double asked_current(const mjModel* m, const mjData* d, int actuator);

// Current of the coil, A.
double coil_current(const mjModel* m, const mjData* d, int actuator);

double magnet_gain(const Config& config, const mjModel* m, const mjData* d, int actuator);  // N/A
double magnet_bias(const Config& config, const mjModel* m, const mjData* d, int actuator);  // N
// d(activation)/dt of a lagging coil, A/s.
double coil_rate(const Config& config, const mjModel* m, const mjData* d, int actuator);

}  // namespace rotorub::plugin
