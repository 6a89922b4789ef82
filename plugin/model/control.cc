#include "plugin/model/control.h"

#include <algorithm>
#include <utility>

#include "native_model/bearing/actuator.h"
#include "native_model/control/control_loop.h"
#include "native_model/model/actuation.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

thread_local bool compiling = false;

// Velocities at the time of the positions. MuJoCo's Euler step is semi-implicit,
//   v_k = v_{k-1} + h a,   q_k = q_{k-1} + h v_k,
// so its v_k is the velocity half a step before t_k. This matters to a controller that compares the
// gap rate with a boundary layer: in a whirl the gap rate is wrong by h/2 v_t^2 / delta. The
// controller therefore receives
//   v(t_k) = v_k + (v_k - v_{k-1}) / 2.
// Records the velocities of the state with its time and writes v(t) (nq values) to `now`. Repeated
// calls at the same time give the same result. v(t) is the state's own velocity if no step of the
// model's length came before, and with RK4, whose velocities are not late.
void velocity_at_time(const Config& config, const mjModel* m, mjData* d, const Coordinates& state,
                      double* now) {
  const int n = config.model.nq();
  const double* v = state.v();
  ModelEntries& data = model_entries(config, d);
  double* earlier = behind(data);
  double* latest = earlier + n;
  if (data.history_length == 0.0 || d->time < data.latest_time) {
    data.history_length = 1.0;
  } else if (d->time > data.latest_time) {
    std::copy_n(latest, n, earlier);
    data.earlier_time = data.latest_time;
    // `impact` still belongs to the previous step. A second pass at this time would find it
    // changed.
    data.history_length = data.contact.impact == 0.0 ? 2.0 : 3.0;
  }
  std::copy_n(v, n, latest);
  data.latest_time = d->time;

  const double h = m->opt.timestep;
  // An impact in the previous step is over, so the velocity must not be extrapolated across it.
  const bool smooth = data.history_length == 2.0 && m->opt.integrator != mjINT_RK4;
  const bool stepped = is_next_step(data.latest_time - data.earlier_time, h, data.latest_time);
  const double share = stepped && smooth ? 0.5 : 0.0;
  for (int i = 0; i < n; ++i) now[i] = v[i] + share * (v[i] - earlier[i]);
  // A sampled law sees the states of sampled magnetic bearings as their last samples left them.
  if (!config.model.first().loop) return;
  const int first = config.model.sampled_states(), end = config.model.layout.coil();
  std::copy(v + first, v + end, now + first);
}

Eigen::Vector2d command_of(const Config& config, const mjModel* m, mjData* d, const double* q,
                           const double* v) {
  const Model& model = config.model;
  const AuxiliaryBearing& ring = model.first();
  if (!ring.loop) return control_command(model, d->time, q, v);
  const Eigen::Vector2d current =
      ring.magnets ? actuator_state(config, m, d).current : Eigen::Vector2d(0.0, 0.0);
  try {
    return control_sample(model, d->time, q, v, current, d->userdata + config.loop_data);
  } catch (const ControllerError& error) {
    controller_failed(d, error.what());
  }
  return {0.0, 0.0};
}

// Requested current within MuJoCo's limits, A. MuJoCo clamps a copy of ctrl, not ctrl itself.
double asked_current(const mjModel* m, const mjData* d, int actuator) {
  const int control = control_address(m, actuator);
  const mjtNum* range = m->actuator_ctrlrange + 2 * control;
  const bool clamps = m->actuator_ctrllimited[control] && !(m->opt.disableflags & mjDSBL_CLAMPCTRL);
  return clamps ? std::clamp(d->ctrl[control], range[0], range[1]) : d->ctrl[control];
}

}  // namespace

WhileCompiling::WhileCompiling() : outer_(std::exchange(compiling, true)) {}
WhileCompiling::~WhileCompiling() { compiling = outer_; }

void controller_failed(mjData* d, const std::string& why) {
  if (compiling) return;
  entries<ModelEntries>(d, 0).contact.status = static_cast<double>(Status::kControllerFailed);
  raise_error(("rotorub: " + why).c_str());
}

void write_command(const Config& config, const mjModel* m, mjData* d) {
  const AuxiliaryBearing& ring = config.model.first();
  if (!ring.controller) return;
  const Coordinates state(config, d);
  double v[kMaxCoordinates];
  velocity_at_time(config, m, d, state, v);
  // Before the controller is on, the command is 0, the value that mj_resetData sets.
  ModelEntries& data = model_entries(config, d);
  Eigen::Vector2d u{data.held_x, data.held_y};
  if (d->time >= ring.control_on) {
    const double sample =
        ring.sample_time > 0.0 ? 1.0 + sample_index(d->time, ring.sample_time) : 0.0;
    if (sample == 0.0 || sample != data.sample) {
      u = command_of(config, m, d, state.q(), v);
      data.held_x = u.x();
      data.held_y = u.y();
      data.sample = sample;
    }
  }
  const Eigen::Vector2d commanded = ring.magnets ? u : to_axes(u);
  for (int k = 0; k < 2; ++k) d->ctrl[control_address(m, config.actuator[k])] = commanded[k];
}

ActuatorState actuator_state(const Config& config, const mjModel* m, const mjData* d) {
  if (config.actuator[0] < 0 || config.actuator[1] < 0) return {};
  const AuxiliaryBearing& ring = config.model.first();
  Eigen::Vector2d force, current{0.0, 0.0};
  for (int k = 0; k < 2; ++k) {
    force[k] = d->actuator_force[force_address(m, config.actuator[k])];
    if (ring.magnets) current[k] = coil_current(m, d, config.actuator[k]);
  }
  ActuatorState now{from_axes(force), current, {}};
  if (ring.loop) {
    const double* outputs = ControlLoop::outputs(d->userdata + config.loop_data);
    std::copy_n(outputs, now.outputs.size(), now.outputs.begin());
  }
  return now;
}

Eigen::Vector2d command_of_pass(const Config& config, const mjModel* m, const mjData* d) {
  const AuxiliaryBearing& ring = config.model.first();
  if (config.actuator[0] < 0 || config.actuator[1] < 0) return {0.0, 0.0};
  if (config.takes_native_steps() && ring.controller && !ring.lags()) {
    const ModelEntries& data = model_entries(config, d);
    return {data.held_x, data.held_y};
  }
  if (!ring.magnets) return actuator_state(config, m, d).force;
  return {asked_current(m, d, config.actuator[0]), asked_current(m, d, config.actuator[1])};
}

bool is_magnet(const Config& config, int actuator) {
  return config.model.first().magnets &&
         (actuator == config.actuator[0] || actuator == config.actuator[1]);
}

double coil_current(const mjModel* m, const mjData* d, int actuator) {
  const int address = activation_address(m, actuator);
  return address < 0 ? asked_current(m, d, actuator) : d->act[address];
}

double magnet_answer(ActuatorQuestion asked, const Config& config, const mjModel* m,
                     const mjData* d, int actuator) {
  const MagneticActuator& magnets = *config.model.first().magnets;
  const double place = d->actuator_length[force_address(m, actuator)];
  const double current = coil_current(m, d, actuator);
  switch (asked) {
    case ActuatorQuestion::kGain:
      return magnets.law->gain(place, current);
    case ActuatorQuestion::kBias:
      return magnets.law->force(place, 0.0);
    case ActuatorQuestion::kRate:
      break;
  }
  return (magnets.coil.load(asked_current(m, d, actuator), current) - current) / magnets.coil.lag;
}

}  // namespace rotorub::plugin
