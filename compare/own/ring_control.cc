#include "compare/own/ring_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "native_model/control/control_loop.h"
#include "native_model/scene/reader.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/twin/probe.h"

namespace rotorub {
namespace {

using Eigen::VectorXd;

// A scene that accepts a [controller]; the law takes the plant from the twin.
constexpr const char* kCarrier = R"(
[run]
[rotor]
speed = 0
[rotor.modal]
mass = [1]
stiffness = [1]
[contact]
radius = 1
clearance = 1
friction = 0
restitution = 0
[stator]
mass = 1
damping = 1
stiffness = 1
)";

[[noreturn]] void refuse_actuator(const mjModel* m, int actuator, const std::string& reason) {
  throw std::runtime_error(
      fmt::format("actuator \"{}\": {}", m->names + m->name_actuatoradr[actuator], reason));
}

double control_unit(const mjModel* m, int control) {
  const double most = m->actuator_ctrlrange[2 * control + 1];
  return m->actuator_ctrllimited[control] && most > 0.0 ? std::min(1.0, most) : 1.0;
}

// Generalised force per unit of ctrl, at rest in qpos0.
VectorXd push_of(const mjModel* m, const plugin::Config& config, int actuator) {
  const MujocoData start = make_start(m);
  std::fill_n(start->ctrl, m->nu, 0.0);
  const VectorXd rest = VectorXd::Zero(m->nv);
  const VectorXd without = plugin::Probe(m, config, start.get()).force(rest);
  const int control = plugin::control_address(m, actuator);
  start->ctrl[control] = control_unit(m, control);
  return (plugin::Probe(m, config, start.get()).force(rest) - without) / start->ctrl[control];
}

// The law's force must reach the ring unchanged.
void check_actuator(const mjModel* m, int actuator) {
  const bool plain = m->actuator_dyntype[actuator] == mjDYN_NONE &&
                     m->actuator_gaintype[actuator] == mjGAIN_FIXED &&
                     !m->actuator_forcelimited[actuator];
  if (!plain) {
    refuse_actuator(m, actuator,
                    "has a state, a gain that varies or a forcerange, which a controller does not "
                    "support; use a <motor> that is limited by its ctrlrange");
  }
  const int control = plugin::control_address(m, actuator);
  const mjtNum* range = m->actuator_ctrlrange + 2 * control;
  if (m->actuator_ctrllimited[control] && range[0] != -range[1]) {
    refuse_actuator(
        m, actuator,
        fmt::format("ctrlrange=\"{} {}\" is not symmetric; a controller needs a range from -c to c",
                    range[0], range[1]));
  }
}

}  // namespace

RingActuators ring_actuators(const mjModel* m, const plugin::Config& config) {
  constexpr double kNone = 1e-9;  // relative to the whole force
  constexpr const char* kAxes = "xy";
  const MujocoData start = make_start(m);
  const Eigen::MatrixXd ring = plugin::Probe(m, config, start.get())
                                   .geom_jacobian(config.pairs.front().ring_geom)
                                   .topRows<2>();
  RingActuators found;
  int at[2] = {-1, -1};
  for (int actuator = 0; actuator < plugin::actuator_count(m); ++actuator) {
    const VectorXd push = push_of(m, config, actuator);
    for (int axis = 0; axis < 2; ++axis) {
      const VectorXd row = ring.row(axis).transpose();
      const double gain = push.dot(row) / std::max(row.squaredNorm(), 1e-300);
      if (std::abs(gain) * row.norm() <= kNone * push.norm() || push.isZero(0.0)) continue;
      if ((push - gain * row).norm() > kNone * push.norm()) {
        refuse_actuator(m, actuator,
                        "pushes more than the ring along x or y of its geom; for a controller, put "
                        "a <motor> on each of the ring's two slides");
      }
      if (at[axis] >= 0) {
        refuse_actuator(m, actuator,
                        fmt::format("pushes the ring along {} as \"{}\" does; for a controller, "
                                    "give one along x and one along y",
                                    kAxes[axis], m->names + m->name_actuatoradr[at[axis]]));
      }
      check_actuator(m, actuator);
      const int control = plugin::control_address(m, actuator);
      at[axis] = actuator;
      found.control[axis] = control;
      found.force_per_control[axis] = gain;
      if (m->actuator_ctrllimited[control]) {
        const double most = std::abs(gain) * m->actuator_ctrlrange[2 * control + 1];
        found.force_limit = std::min(found.force_limit, most * std::numbers::sqrt2 / 2.0);
      }
    }
  }
  for (int axis = 0; axis < 2; ++axis) {
    if (at[axis] >= 0) continue;
    throw std::runtime_error(
        fmt::format("no actuator pushes the ring along {} of its geom; for a controller, put a "
                    "<motor> on each of the ring's two slides",
                    kAxes[axis]));
  }
  return found;
}

scene::Controller controller_of(const std::vector<std::string>& overrides, double sample_time) {
  std::vector<std::string> all{fmt::format("controller.sample_time={:.17g}", sample_time)};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return *scene::parse_scene(kCarrier, "controller", all).first().controller;
}

RingControl::RingControl(std::shared_ptr<const Model> model, ReadState read,
                         const RingActuators& actuators)
    : model_(std::move(model)), read_(std::move(read)), actuators_(actuators), command_(*model_) {}

Eigen::Vector2d RingControl::operator()(mjData* d) {
  const AuxiliaryBearing& ring = model_->first();
  const double sample = ring.loop ? sample_index(d->time, ring.sample_time) : sample_ + 1.0;
  if (sample != sample_ && d->time >= ring.control_on) {
    VectorXd q(model_->nq()), v(model_->nq());
    read_(d, q.data(), v.data());
    force_ = ring.loop ? command_.take(d->time, q.data(), v.data(), force_)
                       : control_command(*model_, d->time, q.data(), v.data());
    if (!command_.failure().empty()) throw ControllerError(command_.failure());
    sample_ = sample;
  }
  for (int axis = 0; axis < 2; ++axis)
    d->ctrl[actuators_.control[axis]] = force_[axis] / actuators_.force_per_control[axis];
  return force_;
}

}  // namespace rotorub
