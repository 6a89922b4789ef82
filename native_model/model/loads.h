// All loads of (9) in one list, which the right-hand sides, the steps and the matrices share. The
// forces of contacts and actuators are separate (equations.h, model/actuation.h), and so are the
// diagonal terms and the weight.
#pragma once

#include <array>

#include "native_model/model/dynamics.h"
#include "native_model/model/feedback_equations.h"

namespace rotorub::equations {

// Forces on rings beyond springs and dampers to the base (dynamics.h).
inline void add_supports(const Model& m, const double* q, const double* v, double* f) {
  if (!m.supports.empty()) add_ring_supports(m, q, v, f);
}

// As above, for a step of length h (s) from the velocities `start`. The motion of the bristles
// within the step is computed exactly, because it may be fast.
inline void add_supports(const Model& m, const double* q, const double* v, const double* start,
                         double h, double* f) {
  if (m.supports.empty()) return;
  add_ring_supports(m, q, v, f);
  step_bristles(m, v, start, h, f);
}

// f += all loads that are linear in (q, v) at a spin speed omega (rad/s), except the diagonal terms
// and the gyroscopic moments: rotating damping, dashpots, films, springs and the laws of magnetic
// bearings. (A law is linear within its limit; films with an offset have a constant part.) working:
// for each feedback the share of the time in which it works, in [0, 1].
inline void add_linear_loads(const Model& m, double omega, const double* working, const double* q,
                             const double* v, double* f) {
  add_rotating_damping(m, q, v, omega, f);
  add_dampers(m, v, f);
  add_films(m, omega, q, v, f);
  add_springs(m, q, f);
  add_feedbacks(m, working, q, v, f);
}

// The shares at an instant t (s): 1 if the feedback works, otherwise 0.
inline std::array<double, scene::kMaxMagneticBearings> working_at(const Model& m, double t) {
  std::array<double, scene::kMaxMagneticBearings> shares{};
  for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
    shares[k] = m.feedbacks[k].works.at(t) ? 1.0 : 0.0;
  }
  return shares;
}

// Load of the base's acceleration a, m/s^2, because the coordinates are relative to the base:
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

// Loads of [[force]] and of the motion of the base at an instant.
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

// The instant at which loads are evaluated, besides (q, v).
struct LoadInstant {
  double t;                  // s, for the motor's torque
  const double* working;     // see add_linear_loads
  const DiscAngles& angles;  // of the eccentric discs, if there are any
};

// Whether add_loads adds the gyroscopic moments. In a step they are among the other loads; a
// right-hand side adds them itself, last. The order affects the last bits of the sum.
enum class Gyroscopics { kAmong, kLeftOut };

// f += all loads of the list. forces(f) adds the loads of [[force]] and of the base, which a step
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
