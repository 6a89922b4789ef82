// Finds the plugin's user sensors in mjData.sensordata.
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <string>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Address of the user sensor of that name; -1: the model has none. Throws ConfigError if the sensor
// has another size.
int sensor_address(const mjModel* m, const std::string& name, int dim);

// The plugin's names of the sensors of a contact.
std::span<const char* const> contact_sensor_names();

// The sensors of one contact. Their names are the plugin's names between prefix and suffix. Throws
// ConfigError.
SensorAddresses contact_sensors(const mjModel* m, const std::string& prefix = {},
                                const std::string& suffix = {});

}  // namespace rotorub::plugin
