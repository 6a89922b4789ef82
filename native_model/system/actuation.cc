#include "native_model/system/actuation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "native_model/bearing/actuator_axes.h"
#include "native_model/control/sampling.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {
namespace {

Measurement measure(const Model& m, double t, const double* q, const double* v) {
  Measurement now;
  now.t = t;
  now.rotor = rotor_point(m, q) - m.ring_offset;  // from the ring's middle at rest, as `stator` is
  now.rotor_velocity = rotor_point(m, v);
  now.stator = stator_point(m, q);
  now.stator_velocity = stator_point(m, v);
  now.q = q;
  now.v = v;
  now.spin_angle = spin_angle(m, t, q);
  now.spin_speed = spin_speed(m, v);
  if (m.controller->needs_rotor_acceleration()) {
    constexpr int kStack = kMaxCoordinates;
    assert(m.nq() <= kStack);
    double a[kStack];
    unactuated_force(m, t, q, v, a);
    solve_mass(m, t, q, a, a);
    now.rotor_acceleration = rotor_point(m, a);
  }
  return now;
}

// Of a continuous law, which does not remember what it found.
SwitchOn switched_on(const Model& m) {
  return {m.control_on, m.contact ? m.contact->clearance : 0.0, 0.0};
}

// What the actuator is told for what the law asks.
Eigen::Vector2d told(const Model& m, const double* q, const Eigen::Vector2d& asked) {
  if (!m.magnets) return limited(asked, m.force_limit);
  const MagneticActuator& magnets = *m.magnets;
  const double most = magnets.current_limit;
  if (m.controller->commands_currents()) return asked.cwiseMin(most).cwiseMax(-most);
  const Eigen::Vector2d s = to_axes(stator_point(m, q)), f = to_axes(asked);
  return {magnets.law->current(s.x(), f.x(), most), magnets.law->current(s.y(), f.y(), most)};
}

}  // namespace

Eigen::Vector2d limited(const Eigen::Vector2d& force, double limit) {
  return from_axes(to_axes(force).cwiseMin(limit).cwiseMax(-limit));
}

Eigen::Vector2d control_command(const Model& m, double t, const double* q, const double* v) {
  if (m.recorded) return m.recorded->at(t);
  if (!m.controller || t < m.control_on) return {0.0, 0.0};
  assert(m.controller->state_size() == 0);
  return told(m, q, m.controller->command(measure(m, t, q, v), switched_on(m), nullptr));
}

Eigen::Vector2d control_sample(const Model& m, double t, const double* q, const double* v,
                               const Eigen::Vector2d& current, double* memory) {
  if (t < m.control_on) return {0.0, 0.0};
  Measurement now = measure(m, t, q, v);
  now.sample = static_cast<std::int64_t>(sample_index(t, m.sample_time));
  now.current = current;
  return told(m, q, m.loop->sample(now, memory));
}

void control_outputs(const Model& m, double t, const double* q, const double* v, double* values) {
  const std::size_t count = m.controller ? m.controller->outputs().size() : 0;
  std::fill_n(values, count, 0.0);
  if (count == 0 || t < m.control_on) return;
  assert(!m.loop);
  m.controller->output(measure(m, t, q, v), switched_on(m), nullptr, values);
}

ActuatorState actuator_state(const Model& m, const double* q, const double* v,
                             const Eigen::Vector2d& command) {
  if (!m.magnets) return {command, {0.0, 0.0}, {}};
  const Layout& l = m.layout;
  const Eigen::Vector2d s = to_axes(stator_point(m, q));
  const Eigen::Vector2d i = l.coils ? Eigen::Vector2d(v[l.coil()], v[l.coil() + 1]) : command;
  const ForceLaw& law = *m.magnets->law;
  return {from_axes({law.force(s.x(), i.x()), law.force(s.y(), i.y())}), i, {}};
}

void smooth_force(const Model& m, double t, const double* q, const double* v,
                  const Eigen::Vector2d& command, double* f) {
  const Layout& l = m.layout;
  unactuated_force(m, t, q, v, f);
  if (!l.stator) return;
  const Eigen::Vector2d force = actuator_state(m, q, v, command).force;
  f[l.ring()] += force.x();
  f[l.ring() + 1] += force.y();
  for (int k = 0; k < l.coils; ++k) {
    f[l.coil() + k] += coil_load(*m.magnets, command[k], v[l.coil() + k]);
  }
}

double coil_load(const MagneticActuator& magnets, double asked, double current) {
  // di/dt of the whole voltage: (+-U - R i) / L.
  const double drop = magnets.resistance * current, rate = magnets.current_rate_limit;
  const double fall = std::max(-rate, (-magnets.voltage_limit - drop) / magnets.inductance);
  const double rise = std::min(rate, (magnets.voltage_limit - drop) / magnets.inductance);
  return std::min(std::max(asked, current + magnets.coil_lag * fall), current + magnets.coil_lag * rise);
}

}  // namespace rotorub
