// The list of the loads of (9), once: whoever integrates, steps, or asks for matrices takes it from
// here. The contact's and the actuator's forces are
// beside it (equations.h, model/actuation.h), and so are the diagonal parts and the weight.
#pragma once

#include <array>

#include "native_model/model/dynamics.h"
#include "native_model/model/feedback_equations.h"

namespace rotorub::equations {

// What carries rings beyond springs and dampers to the base (dynamics.h).
inline void add_supports(const Model& m, const double* q, const double* v, double* f) {
  if (!m.supports.empty()) add_ring_supports(m, q, v, f);
}

// The same in a step of h, s, from the velocities `start`: what bristles do within it is known
// exactly, as they may be quick.
inline void add_supports(const Model& m, const double* q, const double* v, const double* start,
                         double h, double* f) {
  if (m.supports.empty()) return;
  add_ring_supports(m, q, v, f);
  step_bristles(m, v, start, h, f);
}

// All that is linear in (q, v) at a spin speed omega (rad/s) but the diagonal parts and the
// gyroscopic moments: rotating damping, dashpots, films, springs, magnetic bearings' laws. (A
// law is linear within its limit, films that stand off the line have a constant part.)
// working: of each of those bearings the share of the time for which it has not failed, in [0, 1].
inline void add_linear_loads(const Model& m, double omega, const double* working, const double* q,
                             const double* v, double* f) {
  add_rotating_damping(m, q, v, omega, f);
  add_dampers(m, v, f);
  add_films(m, omega, q, v, f);
  add_springs(m, q, f);
  add_feedbacks(m, working, q, v, f);
}

// Those shares at an instant.
inline std::array<double, scene::kMaxMagneticBearings> working_at(const Model& m, double t) {
  std::array<double, scene::kMaxMagneticBearings> shares{};
  for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
    shares[k] = m.feedbacks[k].works.at(t) ? 1.0 : 0.0;
  }
  return shares;
}

// The base's acceleration a, m/s^2: relative to it every mass is held back,
//   f = -m_g a,  m_g the load per unit acceleration (gravity_mass).
inline void add_base_load(const Model& m, const Pair& a, double* f) {
  const double* mass = m.gravity_mass.data();
  const int n = m.layout.modes, rings = m.layout.ring();
  for (int k = 0; k < n; ++k) {
    f[k] -= mass[k] * a.x;
    f[n + k] -= mass[n + k] * a.y;
  }
  for (int i = rings; i < rings + m.layout.stator; i += 2) {
    f[i] -= mass[i] * a.x;
    f[i + 1] -= mass[i + 1] * a.y;
  }
}

// Those of [[force]] and of the base's motion at an instant.
inline void add_forces(const Model& m, double t, const double* q, double* f) {
  if (m.base) {
    const Eigen::Vector2d a = m.base->at(t);
    add_base_load(m, Pair{a.x(), a.y()}, f);
  }
  for (const AppliedForce& force : m.forces) {
    if (t < force.on || t >= force.off) continue;
    const Eigen::Vector2d p = force.at(t, equations::spin_angle(m, t, q));
    add_station_force(m.layout.modes, force.shape, p.x(), p.y(), f);
  }
}

// What a list of loads knows of the instant beside (q, v).
struct LoadInstant {
  double t;                  // s, of the motor's torque
  const double* working;     // as above
  const DiscAngles& angles;  // of the eccentric discs; read where there are any
};

// A right-hand side adds the gyroscopic moments last, a step among the others: the order is that of
// the sum, and so of its last bits.
enum class Gyroscopics { kAmong, kLeftOut };

// f += all loads of the list. forces(f): adds those of [[force]] and the base's, which a step
// averages over its length.
template <Gyroscopics kGyroscopics, class Forces>
inline void add_loads(const Model& m, const LoadInstant& at, const double* q, const double* v,
                      const Forces& forces, double* f) {
  const double omega = equations::spin_speed(m, v);
  add_linear_loads(m, omega, at.working, q, v, f);
  add_supports(m, q, v, f);
  if constexpr (kGyroscopics == Gyroscopics::kAmong) add_gyroscopic(m, omega, v, f);
  forces(f);
  if (!m.unbalances.empty()) add_unbalance(m, at.angles, omega, f);
  add_drive(m, at.t, q, v, f);
}

}  // namespace rotorub::equations
