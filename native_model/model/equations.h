// The terms of the equations of motion (1), (2), (9), each written once. Callers combine them into
// the right-hand side that they need. Nothing here allocates.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "native_model/model/model.h"
#include "native_model/numerics/loops.h"
#include "native_model/numerics/sine_cosine.h"

namespace rotorub::equations {

struct Pair {  // values in the two planes
  double x, y;
};

// f += shape (fx, fy): adds a force at a station. Plain loops, because n is small.
inline void add_station_force(int n, const ModeShape& shape, double fx, double fy, double* f) {
  const double *x = shape.x.data(), *y = shape.y.data();
  ROTORUB_APART for (int k = 0; k < n; ++k) {
    f[k] += fx * x[k];
    f[n + k] += fy * y[k];
  }
}

// Displacement of a station from the coordinates q, or its velocity from their rates.
inline Pair at_station(int n, const ModeShape& shape, const double* q) {
  const double *x = shape.x.data(), *y = shape.y.data();
  Pair sum{x[0] * q[0], y[0] * q[n]};
  for (int k = 1; k < n; ++k) {
    sum.x += x[k] * q[k];
    sum.y += y[k] * q[n + k];
  }
  return sum;
}

// Vector from the ring's centre to the rotor's centre in the contact plane, relative to the rest
// positions; for velocities the relative velocity. `at`: the auxiliary bearing, here and below.
inline Pair relative(const Model& m, const AuxiliaryBearing& at, const double* q) {
  Pair d = at_station(m.layout.modes, at.shape, q);
  if (const int ring = at.ring; ring != kAbsent) {
    d.x -= q[ring];
    d.y -= q[ring + 1];
  }
  return d;
}

// m, vector from the ring's centre to the rotor's centre, including the ring's offset at rest.
inline Pair separation(const Model& m, const AuxiliaryBearing& at, const double* q) {
  const Pair d = relative(m, at, q);
  return {d.x - at.ring_offset.x(), d.y - at.ring_offset.y()};
}

// rad/s, Omega, without torsion.
inline double spin_speed(const Model& m, const double* v) {
  return m.layout.spin ? v[m.layout.phi()] : m.speed;
}

// True if the contact spin has parts other than the rigid spin.
inline bool turns_at_contact(const Model& m) { return m.layout.torsion || m.layout.ring_spin; }

// The part of contact_spin beyond the rigid spin: torsion minus the turning of the ring. Also for
// accelerations.
inline double turning_at_contact(const Model& m, const AuxiliaryBearing& at, const double* v) {
  double sum{};
  const double* shape = at.torsion_shape.data();
  for (int k = 0; k < m.layout.torsion; ++k) sum += shape[k] * v[m.layout.theta() + k];
  if (const int angle = at.ring_angle; angle != kAbsent) sum -= at.ring_ratio * v[angle];
  return sum;
}

// rad/s, Omega_c - (R/r) Omega_r, with Omega_c including torsion. r times it is the rotational part
// of the slip.
inline double contact_spin(const Model& m, const AuxiliaryBearing& at, const double* v) {
  const double omega = equations::spin_speed(m, v);
  return turns_at_contact(m) ? omega + turning_at_contact(m, at, v) : omega;
}

// rad, phi, without torsion.
inline double spin_angle(const Model& m, double t, const double* q) {
  return m.layout.spin ? q[m.layout.phi()] : m.spin_angle + m.speed * t;
}

// Directions of the eccentric discs: cosine and sine of phi + phase. Both are 0 before the
// unbalance appears, which removes all its effects.
struct DiscAngles {
  double cosine[kMaxUnbalances], sine[kMaxUnbalances];

  // At the time t, s.
  void fill(const Model& m, double t, const double* q) {
    const double spin = equations::spin_angle(m, t, q);
    for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
      const double angle = spin + m.unbalances[i].phase;
      if (m.unbalances[i].on <= t) {
        sine_cosine(angle, sine[i], cosine[i]);
      } else {
        sine[i] = cosine[i] = 0.0;
      }
    }
  }
  // For a step from `begin` to `end`, s. An unbalance that appears within the step counts with its
  // share of the step.
  inline void fill(const Model& m, double t, const double* q, double begin, double end) {
    const double spin = equations::spin_angle(m, t, q);
    for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
      sine_cosine(spin + m.unbalances[i].phase, sine[i], cosine[i]);
      const double on = m.unbalances[i].on;
      if (on <= begin) continue;
      const double share = on < end ? (end - on) / (end - begin) : 0.0;
      cosine[i] *= share;
      sine[i] *= share;
    }
  }
};

// b: the bending rows of M(phi) that couple bending with the spin,
// M = diag + b e_phi^T + e_phi b^T. It is the sum over the discs of m e (-sin, cos) times the mode
// values at the station. n values each.
inline void spin_coupling(const Model& m, const DiscAngles& at, double* bx, double* by) {
  const int n = m.layout.modes;
  for (int k = 0; k < n; ++k) bx[k] = by[k] = 0.0;
  for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
    const auto& disc = m.unbalances[i];
    const double *x = disc.shape.x.data(), *y = disc.shape.y.data();
    const double ax = disc.static_moment * at.sine[i], ay = disc.static_moment * at.cosine[i];
    ROTORUB_APART for (int k = 0; k < n; ++k) {
      bx[k] -= ax * x[k];
      by[k] += ay * y[k];
    }
  }
}

inline void add_weight(const Model& m, double* f) {
  if (m.weight.size() == 0) return;
  const int nq = static_cast<int>(m.weight.size());
  const double* weight = m.weight.data();
  ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] += weight[i];
}

// f = weight - K q - D v, the diagonal parts.
inline void diagonal_force(const Model& m, const double* q, const double* v, double* f) {
  const double *stiffness = m.stiffness.data(), *damping = m.damping.data();
  const int nq = static_cast<int>(m.stiffness.size());
  ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] = -(stiffness[i] * q[i] + damping[i] * v[i]);
  add_weight(m, f);
}

// f = weight - D v: diagonal_force() without the springs.
inline void damping_force(const Model& m, const double* v, double* f) {
  const double* damping = m.damping.data();
  const int nq = static_cast<int>(m.damping.size());
  ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] = -(damping[i] * v[i]);
  add_weight(m, f);
}

// Rotating damping (modal_rotor.h): -D_i (qdot - Omega e_z x q).
inline void add_rotating_damping(const Model& m, const double* q, const double* v, double omega,
                                 double* f) {
  if (m.internal_xx.absent() && m.internal_yy.absent()) return;
  const int n = m.layout.modes;
  m.internal_xx.add(-1.0, v, f, n);
  m.internal_yy.add(-1.0, v + n, f + n, n);
  m.internal_xy.add(-omega, q + n, f, n);
  m.internal_xy.add_transposed(omega, q, f + n, n);
}

// Dashpots of the bearings.
inline void add_dampers(const Model& m, const double* v, double* f) {
  const int n = m.layout.modes;
  for (const auto& d : m.dampers) {
    const Pair rate = at_station(n, d.shape, v);
    add_station_force(n, d.shape, -d.damping.x() * rate.x, -d.damping.y() * rate.y, f);
  }
}

// Forces of the bearings beyond their springs and dashpots, at the spin speed omega (rad/s).
inline void add_films(const Model& m, double omega, const double* q, const double* v, double* f) {
  const int n = m.layout.modes;
  for (const auto& film : m.films) {
    const auto c = film.law.at(omega);
    const Pair at = at_station(n, film.shape, q), rate = at_station(n, film.shape, v);
    const double x = at.x - film.law.offset_x, y = at.y - film.law.offset_y;
    add_station_force(n, film.shape, -(c[0] * x + c[1] * y + c[4] * rate.x + c[5] * rate.y),
                      -(c[2] * x + c[3] * y + c[6] * rate.x + c[7] * rate.y), f);
  }
}

// Springs at stations (of magnetic bearings, mostly negative).
inline void add_springs(const Model& m, const double* q, double* f) {
  const int n = m.layout.modes;
  for (const auto& s : m.springs) {
    const Pair r = at_station(n, s.shape, q);
    add_station_force(n, s.shape, -s.stiffness.x() * r.x, -s.stiffness.y() * r.y, f);
  }
}

// Gyroscopic moments, -Omega G v.
inline void add_gyroscopic(const Model& m, double omega, const double* v, double* f) {
  const int n = m.layout.modes;
  m.gyroscopic.add(-omega, v + n, f, n);
  m.gyroscopic.add_transposed(omega, v, f + n, n);
}

// Force m e Omega^2 in the direction of each disc; the part m e dOmega/dt is in the mass matrix.
inline void add_unbalance(const Model& m, const DiscAngles& at, double omega, double* f) {
  for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
    const double size = m.unbalances[i].static_moment * omega * omega;
    add_station_force(m.layout.modes, m.unbalances[i].shape, size * at.cosine[i], size * at.sine[i],
                      f);
  }
}

// rad, angle of the motor; for velocities its speed, rad/s.
inline double at_motor(const Model& m, const double* q) {
  const auto& l = m.layout;
  const double* shape = m.drive_shape.data();
  double sum = q[l.phi()];
  for (int k = 0; k < l.torsion; ++k) sum += shape[k] * q[l.theta() + k];
  return sum;
}

// N m, torque of the drive by its speed and, where they matter, the time and the angle at the
// motor. Call it only with a drive.
inline double motor_torque(const Model& m, double t, const double* q, const double* v) {
  const double speed = at_motor(m, v);
  if (!m.drive_follows()) return m.drive->torque(0.0, 0.0, speed);
  return m.drive->torque(t, at_motor(m, q) - m.drive_angle, speed);
}

inline void add_drive(const Model& m, double t, const double* q, const double* v, double* f) {
  if (!m.layout.spin) return;
  const auto& l = m.layout;
  const double* shape = m.drive_shape.data();
  const double torque = equations::motor_torque(m, t, q, v);
  f[l.phi()] += torque;
  for (int k = 0; k < l.torsion; ++k) f[l.theta() + k] += shape[k] * torque;
}

// f += J^T p for a load on the rotor (x, y, torque about z) at a contact.
inline void add_contact_load(const Model& m, const AuxiliaryBearing& at, double px, double py,
                             double pz, double* f) {
  const auto& l = m.layout;
  add_station_force(l.modes, at.shape, px, py, f);
  if (l.spin) f[l.phi()] += pz;
  const double* shape = at.torsion_shape.data();
  for (int k = 0; k < l.torsion; ++k) f[l.theta() + k] += shape[k] * pz;
  if (const int ring = at.ring; ring != kAbsent) {
    f[ring] -= px;
    f[ring + 1] -= py;
  }
  if (const int angle = at.ring_angle; angle != kAbsent) f[angle] -= at.ring_ratio * pz;
}

}  // namespace rotorub::equations
