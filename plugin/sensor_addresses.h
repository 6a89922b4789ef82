// Where our user sensors are in mjData.sensordata. contact_sensors (config.h) finds those of one
// contact.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "plugin/config.h"

namespace rotorub::plugin {

// Address of the user sensor of that name; -1: taken out, or another's. Throws ConfigError for
// another size.
int sensor_address(const mjModel* m, const std::string& name, int dim);

// All of a generated model but its shadow's. Throws ConfigError.
SensorAddresses scene_sensors(const mjModel* m);

}  // namespace rotorub::plugin
