// Where our user sensors are in mjData.sensordata.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Address of the user sensor of that name; -1: taken out, or another's. Throws ConfigError for
// another size.
int sensor_address(const mjModel* m, const std::string& name, int dim);

// The sensors of one contact, whose names are ours between prefix and suffix. Throws ConfigError.
SensorAddresses contact_sensors(const mjModel* m, const std::string& prefix = {},
                                const std::string& suffix = {});

}  // namespace rotorub::plugin
