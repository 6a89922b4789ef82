#include "plugin/magnets.h"

#include <algorithm>

#include "native_model/system/actuation.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

const mjtNum* activation(const mjModel* m, const mjData* d, int actuator) {
  const int address = activation_address(m, actuator);
  return address < 0 ? nullptr : d->act + address;
}

}  // namespace

// MuJoCo clamps its own copy of ctrl.
double asked_current(const mjModel* m, const mjData* d, int actuator) {
  const int control = control_address(m, actuator);
  const mjtNum* range = m->actuator_ctrlrange + 2 * control;
  const bool clamps = m->actuator_ctrllimited[control] && !(m->opt.disableflags & mjDSBL_CLAMPCTRL);
  return clamps ? std::clamp(d->ctrl[control], range[0], range[1]) : d->ctrl[control];
}

bool is_magnet(const Config& config, int actuator) {
  return config.model.first().magnets &&
         (actuator == config.actuator[0] || actuator == config.actuator[1]);
}

double coil_current(const mjModel* m, const mjData* d, int actuator) {
  const mjtNum* act = activation(m, d, actuator);
  return act ? *act : asked_current(m, d, actuator);
}

double magnet_gain(const Config& config, const mjModel* m, const mjData* d, int actuator) {
  return config.model.first().magnets->law->gain(d->actuator_length[force_address(m, actuator)],
                                                 coil_current(m, d, actuator));
}

double magnet_bias(const Config& config, const mjModel* m, const mjData* d, int actuator) {
  return config.model.first().magnets->law->force(d->actuator_length[force_address(m, actuator)],
                                                  0.0);
}

double coil_rate(const Config& config, const mjModel* m, const mjData* d, int actuator) {
  const MagneticActuator& magnets = *config.model.first().magnets;
  const double current = coil_current(m, d, actuator);
  return (coil_load(magnets, asked_current(m, d, actuator), current) - current) / magnets.coil_lag;
}

}  // namespace rotorub::plugin
