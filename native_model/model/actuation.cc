#include "native_model/model/actuation.h"

#include <algorithm>
#include <cassert>

#include "native_model/bearing/actuator.h"
#include "native_model/control/control_loop.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/sampled_feedback.h"

namespace rotorub {
namespace {

Measurement measure(const Model& m, std::size_t k, double t, const double* q, const double* v) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  Measurement now;
  now.t = t;
  // Relative to the ring's middle at rest, as `stator` is.
  now.rotor = rotor_point(m, q, k) - at.ring_offset;
  now.rotor_velocity = rotor_point(m, v, k);
  now.stator = stator_point(m, q, k);
  now.stator_velocity = stator_point(m, v, k);
  now.q = q;
  now.v = v;
  now.spin_angle = spin_angle(m, t, q);
  now.spin_speed = spin_speed(m, v);
  if (at.controller->needs_rotor_acceleration()) {
    double a[kMaxCoordinates];
    unactuated_force(m, t, q, v, a);
    solve_mass(m, t, q, a, a);
    now.rotor_acceleration = rotor_point(m, a, k);
  }
  return now;
}

// For a continuous law, which does not remember the gap at switch-on.
SwitchOn switched_on(const AuxiliaryBearing& at) {
  return {at.control_on, at.contact ? at.contact->clearance : 0.0, 0.0};
}

// The actuator's command for the output of the law.
Eigen::Vector2d commanded(const Model& m, std::size_t k, const double* q,
                          const Eigen::Vector2d& asked) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  if (!at.magnets) return limited(asked, at.force_limit);
  const MagneticActuator& magnets = *at.magnets;
  const double most = magnets.current_limit;
  if (at.controller->commands_currents()) return asked.cwiseMin(most).cwiseMax(-most);
  const Eigen::Vector2d s = to_axes(stator_point(m, q, k)), f = to_axes(asked);
  return {magnets.law->current(s.x(), f.x(), most), magnets.law->current(s.y(), f.y(), most)};
}

}  // namespace

Eigen::Vector2d limited(const Eigen::Vector2d& force, double limit) {
  return from_axes(to_axes(force).cwiseMin(limit).cwiseMax(-limit));
}

Eigen::Vector2d control_command(const Model& m, double t, const double* q, const double* v,
                                std::size_t k) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  if (at.recorded) return at.recorded->at(t);
  if (!at.controller || t < at.control_on) return {0.0, 0.0};
  assert(at.controller->state_size() == 0);
  return commanded(m, k, q,
                   at.controller->command(measure(m, k, t, q, v), switched_on(at), nullptr));
}

Eigen::Vector2d control_sample(const Model& m, double t, const double* q, const double* v,
                               const Eigen::Vector2d& current, double* memory, std::size_t k) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  if (t < at.control_on) return {0.0, 0.0};
  Measurement now = measure(m, k, t, q, v);
  double begun[kMaxCoordinates];
  if (!m.samplers.empty()) {
    std::copy_n(v, m.nq(), begun);
    begin_samples(m, t, q, begun);
    now.v = begun;
  }
  now.sample = static_cast<std::int64_t>(sample_index(t, at.sample_time));
  now.current = current;
  return commanded(m, k, q, at.loop->sample(now, memory));
}

void control_outputs(const Model& m, double t, const double* q, const double* v, double* values,
                     std::size_t k) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  const std::size_t count = at.controller ? at.controller->outputs().size() : 0;
  std::fill_n(values, count, 0.0);
  if (count == 0 || t < at.control_on) return;
  assert(!at.loop);
  at.controller->output(measure(m, k, t, q, v), switched_on(at), nullptr, values);
}

ActuatorState actuator_state(const Model& m, const double* q, const double* v,
                             const Eigen::Vector2d& command, std::size_t k) {
  const AuxiliaryBearing& at = m.auxiliary[k];
  if (!at.magnets) return {command, {0.0, 0.0}, {}};
  const Eigen::Vector2d s = to_axes(stator_point(m, q, k));
  const Eigen::Vector2d i =
      at.coil != kAbsent ? Eigen::Vector2d(v[at.coil], v[at.coil + 1]) : command;
  const ForceLaw& law = *at.magnets->law;
  return {from_axes({law.force(s.x(), i.x()), law.force(s.y(), i.y())}), i, {}};
}

void smooth_force(const Model& m, double t, const double* q, const double* v,
                  std::span<const Eigen::Vector2d> commands, double* f) {
  unactuated_force(m, t, q, v, f);
  add_actuators(m, q, v, commands, f);
}

void add_actuators(const Model& m, const double* q, const double* v,
                   std::span<const Eigen::Vector2d> commands, double* f) {
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const AuxiliaryBearing& at = m.auxiliary[k];
    if (!at.moves()) continue;
    const Eigen::Vector2d command = k < commands.size() ? commands[k] : Eigen::Vector2d(0.0, 0.0);
    const Eigen::Vector2d force = actuator_state(m, q, v, command, k).force;
    f[at.ring] += force.x();
    f[at.ring + 1] += force.y();
    if (at.coil == kAbsent) continue;
    // The damping of the coil's coordinate is its term -i.
    for (int i = 0; i < 2; ++i) f[at.coil + i] += at.magnets->coil.load(command[i], v[at.coil + i]);
  }
}

SampledCommand::SampledCommand(const Model& model, std::size_t bearing)
    : model_(&model), bearing_(bearing), memory_(memory_size(model, bearing)) {}

void SampledCommand::clear() {
  std::fill(memory_.begin(), memory_.end(), 0.0);
  failure_.clear();
}

Eigen::Vector2d SampledCommand::take(double t, const double* q, const double* v,
                                     const Eigen::Vector2d& held, const Eigen::Vector2d* shown) {
  const Model& m = *model_;
  Eigen::Vector2d current{0.0, 0.0};
  if (m.auxiliary[bearing_].magnets) {
    current = shown ? *shown : actuator_state(m, q, v, held, bearing_).current;
  }
  try {
    return control_sample(m, t, q, v, current, memory_.data(), bearing_);
  } catch (const ControllerError& error) {
    if (failure_.empty()) failure_ = error.what();
    return held;
  }
}

std::array<double, kMostOutputs> SampledCommand::outputs() const {
  std::array<double, kMostOutputs> values{};
  if (!memory_.empty()) {
    std::copy_n(ControlLoop::outputs(memory_.data()), values.size(), values.begin());
  }
  return values;
}

std::size_t SampledCommand::memory_size(const Model& model, std::size_t bearing) {
  const auto& loop = model.auxiliary[bearing].loop;
  return loop ? loop->memory_size() : 0;
}

void SampledCommand::save(double* to) const { std::copy(memory_.begin(), memory_.end(), to); }

void SampledCommand::restore(const double* from) {
  std::copy_n(from, memory_.size(), memory_.begin());
  failure_.clear();
}

}  // namespace rotorub
