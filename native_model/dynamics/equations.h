// The equations of motion (1), (2), (9), part by part and written once: templates over the model M,
// which is a Model, or many of them side by side (stepping/lane_model.h); T = M::Scalar. Whoever
// needs a right-hand side puts it together from these. Nothing here allocates.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

#include "native_model/numerics/lanes.h"
#include "native_model/numerics/sine_cosine.h"
#include "native_model/system/model.h"

namespace rotorub::equations {

template <class T>
struct Pair {  // of the two planes
  T x, y;
};

// f += shape (fx, fy): a force at a station. Plain loops: n is small.
template <class T, class Shape>
ROTORUB_INLINE void add_station_force(int n, const Shape& shape, const T& fx, const T& fy, T* f) {
  const T *x = shape.x.data(), *y = shape.y.data();
  ROTORUB_APART for (int k = 0; k < n; ++k) {
    f[k] += fx * x[k];
    f[n + k] += fy * y[k];
  }
}

template <class T, class Shape>
ROTORUB_INLINE Pair<T> at_station(int n, const Shape& shape, const T* q) {
  const T *x = shape.x.data(), *y = shape.y.data();
  Pair<T> sum{x[0] * q[0], y[0] * q[n]};
  for (int k = 1; k < n; ++k) {
    sum.x += x[k] * q[k];
    sum.y += y[k] * q[n + k];
  }
  return sum;
}

template <class M>
inline constexpr bool has_run_time_layout =
    std::is_same_v<std::remove_cvref_t<decltype(M::layout)>, Layout>;

// Where the coordinates of an auxiliary bearing's ring begin, kAbsent: nowhere. Of a layout that
// the compiler knows so is this.
template <class M, class B>
ROTORUB_INLINE int ring_of([[maybe_unused]] const M& m, [[maybe_unused]] const B& at) {
  if constexpr (has_run_time_layout<M>) {
    return at.ring;
  } else {
    return m.layout.stator ? m.layout.ring() : kAbsent;
  }
}
template <class M, class B>
ROTORUB_INLINE int ring_angle_of(const M&, [[maybe_unused]] const B& at) {
  if constexpr (has_run_time_layout<M>) {
    return at.ring_angle;
  } else {
    return kAbsent;  // no known layout has one
  }
}

// Of the centres in the contact plane, ring to rotor: the relative velocity, or displacement from
// rest. `at`: the auxiliary bearing, here and below; without it the first.
template <class M, class B, class T = typename M::Scalar>
ROTORUB_INLINE Pair<T> relative(const M& m, const B& at, const T* q) {
  Pair<T> d = at_station(m.layout.modes, at.shape, q);
  if (const int ring = ring_of(m, at); ring != kAbsent) {
    d.x -= q[ring];
    d.y -= q[ring + 1];
  }
  return d;
}
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE Pair<T> relative(const M& m, const T* q) {
  return relative(m, m.first(), q);
}

// The relative position: with where the ring is at rest.
template <class M, class B, class T = typename M::Scalar>
ROTORUB_INLINE Pair<T> separation(const M& m, const B& at, const T* q) {
  const Pair<T> d = relative(m, at, q);
  return {d.x - at.ring_offset.x(), d.y - at.ring_offset.y()};
}
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE Pair<T> separation(const M& m, const T* q) {
  return separation(m, m.first(), q);
}

// Omega, without torsion.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE T spin_speed(const M& m, const T* v) {
  return m.layout.spin ? v[m.layout.phi()] : m.speed;
}

// Whether anything but the rigid spin turns at a contact.
template <class M>
ROTORUB_INLINE bool turns_at_contact(const M& m) {
  return m.layout.torsion || m.layout.ring_spin;
}

// Of contact_spin what is not the rigid spin: torsion, less the ring's turning; of accelerations
// too.
template <class M, class B, class T = typename M::Scalar>
ROTORUB_INLINE T turning_at_contact(const M& m, const B& at, const T* v) {
  T sum{};
  const T* shape = at.torsion_shape.data();
  for (int k = 0; k < m.layout.torsion; ++k) sum += shape[k] * v[m.layout.theta() + k];
  if (const int angle = ring_angle_of(m, at); angle != kAbsent) sum -= at.ring_ratio * v[angle];
  return sum;
}

// Omega_c - (R/r) Omega_r, Omega_c with torsion: r times it is what turning has of the slip.
template <class M, class B, class T = typename M::Scalar>
ROTORUB_INLINE T contact_spin(const M& m, const B& at, const T* v) {
  const T omega = spin_speed(m, v);
  return turns_at_contact(m) ? omega + turning_at_contact(m, at, v) : omega;
}
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE T contact_spin(const M& m, const T* v) {
  return contact_spin(m, m.first(), v);
}

// phi, without torsion.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE T spin_angle(const M& m, double t, const T* q) {
  return m.layout.spin ? q[m.layout.phi()] : m.spin_angle + m.speed * lanes::all<T>(t);
}

// The directions of the eccentric discs: cosine and sine of phi + phase; both 0 of one that is not
// there yet, with which all that it does is 0.
template <class T>
struct DiscAngles {
  T cosine[kMaxUnbalances], sine[kMaxUnbalances];

  // At an instant, s.
  template <class M>
  void fill(const M& m, double t, const T* q) {
    const T spin = equations::spin_angle(m, t, q);
    for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
      const T angle = spin + m.unbalances[i].phase;
      if (m.unbalances[i].on <= t) {
        sine_cosine<T>(angle, sine[i], cosine[i]);
      } else {
        sine[i] = cosine[i] = T{};
      }
    }
  }
  // Of a step from `begin` to `end`, s: those that come within it count with their share of it.
  template <class M>
  ROTORUB_INLINE void fill(const M& m, double t, const T* q, const T& begin, const T& end) {
    const T spin = equations::spin_angle(m, t, q), zero{};
    for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
      sine_cosine<T>(spin + m.unbalances[i].phase, sine[i], cosine[i]);
      const T& on = m.unbalances[i].on;
      if (!lanes::any(on > begin)) continue;
      const T share = lanes::select(on < end, (end - on) / (end - begin), zero);
      const auto there = on <= begin;
      cosine[i] = lanes::select(there, cosine[i], share * cosine[i]);
      sine[i] = lanes::select(there, sine[i], share * sine[i]);
    }
  }
};

// b: the bending rows of M(phi) that couple them with the spin, M = diag + b e_phi^T + e_phi b^T;
// m e (-sin, cos) of each disc through the mode values of its station. n values each.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void spin_coupling(const M& m, const DiscAngles<T>& at, T* bx, T* by) {
  const int n = m.layout.modes;
  for (int k = 0; k < n; ++k) bx[k] = by[k] = T{};
  for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
    const auto& disc = m.unbalances[i];
    const T *x = disc.shape.x.data(), *y = disc.shape.y.data();
    const T ax = disc.static_moment * at.sine[i], ay = disc.static_moment * at.cosine[i];
    ROTORUB_APART for (int k = 0; k < n; ++k) {
      bx[k] -= ax * x[k];
      by[k] += ay * y[k];
    }
  }
}

// f = weight - K q - D v, the diagonal parts.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void diagonal_force(const M& m, const T* q, const T* v, T* f) {
  const T *stiffness = m.stiffness.data(), *damping = m.damping.data();
  const int nq = m.layout.nq();
  ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] = -(stiffness[i] * q[i] + damping[i] * v[i]);
  if (m.weight.size() == 0) return;
  const T* weight = m.weight.data();
  ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] += weight[i];
}

// f = weight - D v: of the same what is not a spring's.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void damping_force(const M& m, const T* v, T* f) {
  const T* damping = m.damping.data();
  const int nq = m.layout.nq();
  ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] = -(damping[i] * v[i]);
  if (m.weight.size() == 0) return;
  const T* weight = m.weight.data();
  ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] += weight[i];
}

// Rotating damping, see modal_rotor.h: -D_i (qdot - Omega e_z x q).
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void add_rotating_damping(const M& m, const T* q, const T* v, const T& omega, T* f) {
  if (m.internal_xx.absent() && m.internal_yy.absent()) return;
  const int n = m.layout.modes;
  const T minus = lanes::all<T>(-1.0);
  m.internal_xx.add(minus, v, f, n);
  m.internal_yy.add(minus, v + n, f + n, n);
  m.internal_xy.add(-omega, q + n, f, n);
  m.internal_xy.add_transposed(omega, q, f + n, n);
}

// Dashpots of the bearings.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void add_dampers(const M& m, const T* v, T* f) {
  const int n = m.layout.modes;
  for (const auto& d : m.dampers) {
    const Pair<T> rate = at_station(n, d.shape, v);
    add_station_force<T>(n, d.shape, -d.damping.x() * rate.x, -d.damping.y() * rate.y, f);
  }
}

// Bearings beyond their springs and dashpots, at the speed omega.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void add_films(const M& m, const T& omega, const T* q, const T* v, T* f) {
  const int n = m.layout.modes;
  for (const auto& film : m.films) {
    const auto c = film.law.at(omega);
    const Pair<T> at = at_station(n, film.shape, q), rate = at_station(n, film.shape, v);
    const T x = at.x - film.law.offset_x, y = at.y - film.law.offset_y;
    add_station_force<T>(n, film.shape, -(c[0] * x + c[1] * y + c[4] * rate.x + c[5] * rate.y),
                         -(c[2] * x + c[3] * y + c[6] * rate.x + c[7] * rate.y), f);
  }
}

// Springs at stations: the magnetic bearing's negative ones.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void add_springs(const M& m, const T* q, T* f) {
  const int n = m.layout.modes;
  for (const auto& s : m.springs) {
    const Pair<T> r = at_station(n, s.shape, q);
    add_station_force<T>(n, s.shape, -s.stiffness.x() * r.x, -s.stiffness.y() * r.y, f);
  }
}

// -Omega G v.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void add_gyroscopic(const M& m, const T& omega, const T* v, T* f) {
  const int n = m.layout.modes;
  m.gyroscopic.add(-omega, v + n, f, n);
  m.gyroscopic.add_transposed(omega, v, f + n, n);
}

// m e Omega^2 at each disc's angle; the m e dOmega/dt part is in the mass matrix.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void add_unbalance(const M& m, const DiscAngles<T>& at, const T& omega, T* f) {
  for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
    const T size = m.unbalances[i].static_moment * omega * omega;
    add_station_force<T>(m.layout.modes, m.unbalances[i].shape, size * at.cosine[i],
                         size * at.sine[i], f);
  }
}

// The angle of the motor, or its speed.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE T at_motor(const M& m, const T* q) {
  const auto& l = m.layout;
  const T* shape = m.drive_shape.data();
  T sum = q[l.phi()];
  for (int k = 0; k < l.torsion; ++k) sum += shape[k] * q[l.theta() + k];
  return sum;
}

// The drive's torque, by speed and where it matters time and angle at the motor; with a drive only.
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE T motor_torque(const M& m, double t, const T* q, const T* v) {
  const T speed = at_motor(m, v);
  if (!m.drive_follows()) return m.drive_torque(0.0, T{}, speed);
  return m.drive_torque(t, at_motor(m, q) - m.drive_angle, speed);
}

template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void add_drive(const M& m, double t, const T* q, const T* v, T* f) {
  if (!m.layout.spin) return;
  const auto& l = m.layout;
  const T* shape = m.drive_shape.data();
  const T torque = motor_torque(m, t, q, v);
  f[l.phi()] += torque;
  for (int k = 0; k < l.torsion; ++k) f[l.theta() + k] += shape[k] * torque;
}

// f += J^T p of a load on the rotor (x, y, torque about z) at a contact.
template <class M, class B, class T = typename M::Scalar>
ROTORUB_INLINE void add_contact_load(const M& m, const B& at, const T& px, const T& py, const T& pz,
                                     T* f) {
  const auto& l = m.layout;
  add_station_force<T>(l.modes, at.shape, px, py, f);
  if (l.spin) f[l.phi()] += pz;
  const T* shape = at.torsion_shape.data();
  for (int k = 0; k < l.torsion; ++k) f[l.theta() + k] += shape[k] * pz;
  if (const int ring = ring_of(m, at); ring != kAbsent) {
    f[ring] -= px;
    f[ring + 1] -= py;
  }
  if (const int angle = ring_angle_of(m, at); angle != kAbsent) f[angle] -= at.ring_ratio * pz;
}
template <class M, class T = typename M::Scalar>
ROTORUB_INLINE void add_contact_load(const M& m, const T& px, const T& py, const T& pz, T* f) {
  add_contact_load(m, m.first(), px, py, pz, f);
}

}  // namespace rotorub::equations
