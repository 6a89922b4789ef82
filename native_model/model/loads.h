// The loads of (9) that the right-hand sides (dynamics.cc), the steps (stepping/load_kick.h) and
// the matrices (linear_parts.h) share. The forces of contacts and actuators are separate
// (equations.h, model/actuation.h), and so are the diagonal terms and the weight.
#pragma once

#include <algorithm>
#include <array>

#include "native_model/model/dynamics.h"
#include "native_model/model/feedback_equations.h"

namespace rotorub::equations {

// f += all loads that are linear in (q, v) at a spin speed omega (rad/s), except the diagonal terms
// and the gyroscopic moments: rotating damping, dashpots, films, springs and the laws of magnetic
// bearings. (A law is linear within its limit; films with an offset have a constant part.) working:
// for each feedback the share of the time in which it works, in [0, 1]. springs: false leaves them
// out, for the power of the forces that the stored energy does not contain.
inline void add_linear_loads(const Model& m, double omega, const double* working, const double* q,
                             const double* v, double* f, bool springs = true) {
  add_rotating_damping(m, q, v, omega, f);
  add_dampers(m, v, f);
  add_films(m, omega, q, v, f);
  if (springs) add_springs(m, q, f);
  add_feedbacks(m, working, q, v, f);
}

// False if add_linear_loads() adds nothing.
inline bool has_linear_loads(const Model& m) {
  return !(m.internal_xx.absent() && m.internal_yy.absent() && m.dampers.empty() &&
           m.films.empty() && m.springs.empty() && m.feedbacks.empty());
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

// Calls action(t) for each instant (s) at which a load may jump, in no order.
template <class Action>
void for_each_switch(const Model& m, const Action& action) {
  for (const AppliedForce& force : m.forces) {
    action(force.on);
    action(force.off);
  }
  for (const DiscUnbalance& unbalance : m.unbalances) action(unbalance.on);
  if (m.base) std::ranges::for_each(m.base->jumps(), action);
  for (const StationFeedback& f : m.feedbacks) std::ranges::for_each(f.works.all(), action);
}

}  // namespace rotorub::equations
