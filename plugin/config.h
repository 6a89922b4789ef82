// What the plugin knows of one mjModel: the native model of the scene in its custom text, and where
// the scene's parts are in MuJoCo's arrays. Constant, shared between threads.
#pragma once

#include <mujoco/mujoco.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "native_model/system/model.h"

namespace rotorub::plugin {

// Addresses in mjData.sensordata; -1: the model has no such sensor.
struct SensorAddresses {
  int active = -1, gap = -1, gap_rate = -1, slip = -1;
  int normal_force = -1, friction_force = -1, control_force = -1;
};

struct Config {
  Model model;
  scene::ContactModel contact = scene::ContactModel::kCoulomb;

  // Coordinate i of the native layout is qpos[qpos_address[i]], qvel[dof_address[i]].
  std::vector<int> qpos_address, dof_address;
  bool same_order = false;  // both are 0, 1, 2, ...

  int rotor_geom = -1, ring_geom = -1;  // of the contact pair; -1 without [contact]
  int pair = -1;                        // their <pair>
  int actuator[2] = {-1, -1};           // -1 without actuators
  SensorAddresses sensors;

  // What the above was made from, to recognise the model: all custom text and all names, sizes.
  std::string fingerprint;
  double id = 0.0;  // unique in the process, > 0
};

// Custom text or a named element that does not fit. what() names it.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The text of <custom><text name="rotorub_scene">, or null: not our model.
const char* scene_text(const mjModel* m);

// Throws ConfigError.
Config make_config(const mjModel* m);

bool same_fingerprint(const Config& config, const mjModel* m);

}  // namespace rotorub::plugin
