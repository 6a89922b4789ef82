#include "plugin/control.h"

#include <algorithm>

#include "native_model/bearing/actuator.h"
#include "native_model/control/control_loop.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/system/actuation.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/magnets.h"
#include "plugin/mujoco_versions.h"
#include "plugin/user_data.h"
#include "plugin/velocity_history.h"

namespace rotorub::plugin {
namespace {

Eigen::Vector2d command_of(const Config& config, const mjModel* m, mjData* d, const double* q,
                           const double* v) {
  const Model& model = config.model;
  if (!model.first().loop) return control_command(model, d->time, q, v);
  const Eigen::Vector2d current =
      model.first().magnets ? actuator_state(config, m, d).current : Eigen::Vector2d(0.0, 0.0);
  try {
    return control_sample(model, d->time, q, v, current, d->userdata + config.loop_data);
  } catch (const ControllerError& error) {
    controller_failed(d, error.what());
  }
  return {0.0, 0.0};
}

}  // namespace

void controller_failed(mjData* d, const std::string& why) {
  d->userdata[kContactStatus] = static_cast<double>(Status::kControllerFailed);
  raise_error(("rotorub: " + why).c_str());
}

void write_command(const Config& config, const mjModel* m, mjData* d, const Coordinates& state) {
  const Model& model = config.model;
  if (!model.first().controller) return;
  double v[kMaxCoordinates];
  velocity_at_time(config, m, d, state, v);
  // Before it is on: 0, the value of mj_resetData.
  Eigen::Vector2d u{d->userdata[kHeldX], d->userdata[kHeldY]};
  if (d->time >= model.first().control_on) {
    const double sample = model.first().sample_time > 0.0
                              ? 1.0 + sample_index(d->time, model.first().sample_time)
                              : 0.0;
    if (sample == 0.0 || sample != d->userdata[kSample]) {
      u = command_of(config, m, d, state.q(), v);
      d->userdata[kHeldX] = u.x();
      d->userdata[kHeldY] = u.y();
      d->userdata[kSample] = sample;
    }
  }
  const Eigen::Vector2d told = model.first().magnets ? u : to_axes(u);
  for (int k = 0; k < 2; ++k) d->ctrl[control_address(m, config.actuator[k])] = told[k];
}

ActuatorState actuator_state(const Config& config, const mjModel* m, const mjData* d) {
  if (config.actuator[0] < 0 || config.actuator[1] < 0) return {};
  Eigen::Vector2d force, current{0.0, 0.0};
  for (int k = 0; k < 2; ++k) {
    force[k] = d->actuator_force[force_address(m, config.actuator[k])];
    if (config.model.first().magnets) current[k] = coil_current(m, d, config.actuator[k]);
  }
  ActuatorState now{from_axes(force), current, {}};
  if (config.model.first().loop) {
    const double* outputs = ControlLoop::outputs(d->userdata + config.loop_data);
    std::copy_n(outputs, now.outputs.size(), now.outputs.begin());
  }
  return now;
}

Eigen::Vector2d command_of_pass(const Config& config, const mjModel* m, const mjData* d) {
  const Model& model = config.model;
  if (config.actuator[0] < 0 || config.actuator[1] < 0) return {0.0, 0.0};
  const bool lags = model.first().magnets && model.first().magnets->coil_lag > 0.0;
  if (config.takes_native_steps() && model.first().controller && !lags) {
    return {d->userdata[kHeldX], d->userdata[kHeldY]};
  }
  if (!model.first().magnets) return actuator_state(config, m, d).force;
  return {asked_current(m, d, config.actuator[0]), asked_current(m, d, config.actuator[1])};
}

}  // namespace rotorub::plugin
