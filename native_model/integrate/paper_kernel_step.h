// The step of a PaperKernel, all inline: whoever calls it chooses the instruction set.
#pragma once

#include <cmath>
#include <limits>

#include "native_model/integrate/paper_kernel.h"
#include "native_model/system/dynamics.h"

namespace rotorub {

inline constexpr std::int64_t kResync = 256;  // steps between exact sines of a rotating force

template <class T>
auto PaperKernel<T>::relative(const T* q) const -> Centre {
  const int n = layout_.modes;
  Centre d{contact_x_[0] * q[0], contact_y_[0] * q[n]};
  for (int k = 1; k < n; ++k) {
    d.x += contact_x_[static_cast<std::size_t>(k)] * q[k];
    d.y += contact_y_[static_cast<std::size_t>(k)] * q[n + k];
  }
  if (layout_.stator) {
    d.x -= q[layout_.ring()];
    d.y -= q[layout_.ring() + 1];
  }
  return d;
}

template <class T>
T PaperKernel<T>::spin_at_contact(const T* v) const {
  T omega = layout_.spin ? v[layout_.phi()] : speed_;
  for (int k = 0; k < layout_.torsion; ++k) {
    omega += torsion_contact_[static_cast<std::size_t>(k)] * v[layout_.theta() + k];
  }
  return omega;
}

// f += shape (fx, fy).
template <class T>
void PaperKernel<T>::add_station(const lanes::Array<T>& sx, const lanes::Array<T>& sy, T fx, T fy) {
  const int n = layout_.modes;
  T* f = f_.data();
  for (int k = 0; k < n; ++k) {
    f[k] += sx[static_cast<std::size_t>(k)] * fx;
    f[n + k] += sy[static_cast<std::size_t>(k)] * fy;
  }
}

// out += factor A in, or A^T.
template <class T>
void PaperKernel<T>::multiply(const Matrix& m, T factor, const T* in, T* out,
                              bool transposed) const {
  const int n = layout_.modes;
  const T* a = m.a.data();
  if (m.kind == ModeMatrix::Kind::kDiagonal) {
    for (int k = 0; k < n; ++k) out[k] += factor * a[k * n + k] * in[k];
    return;
  }
  for (int i = 0; i < n; ++i) {
    T sum{};
    for (int j = 0; j < n; ++j) sum += (transposed ? a[j * n + i] : a[i * n + j]) * in[j];
    out[i] += factor * sum;
  }
}

// The gyroscopic turn of the new velocities over h at the speed omega, by the Cayley transform.
template <class T>
void PaperKernel<T>::rotate(T omega, double h) {
  const int n = layout_.modes;
  T *vx = v_new_.data(), *vy = v_new_.data() + n;
  const T half = lanes::all<T>(0.5 * h) * omega, one = lanes::all<T>(1.0);
  const auto turn = [&](T rate, T& a, T& b) {
    const T tau = rate * half, factor = one / (one + tau * tau);
    const T c = (one - tau * tau) * factor, s = (tau + tau) * factor, a0 = a;
    a = c * a0 - s * b;
    b = s * a0 + c * b;
  };
  if (rotates_diagonal_) {
    for (int k = 0; k < n; ++k) {
      const auto d = static_cast<std::size_t>(k * n + k);
      T a = to_x_[d] * vx[k], b = to_y_[d] * vy[k];
      turn(turn_rate_[static_cast<std::size_t>(k)], a, b);
      vx[k] = from_x_[d] * a;
      vy[k] = from_y_[d] * b;
    }
    return;
  }
  const auto product = [n](const lanes::Array<T>& m, const T* in, T* out) {
    for (int i = 0; i < n; ++i) {
      T sum{};
      for (int j = 0; j < n; ++j) sum += m[static_cast<std::size_t>(i * n + j)] * in[j];
      out[i] = sum;
    }
  };
  product(to_x_, vx, pair_a_.data());
  product(to_y_, vy, pair_b_.data());
  for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
    turn(turn_rate_[k], pair_a_[k], pair_b_[k]);
  }
  product(from_x_, pair_a_.data(), vx);
  product(from_y_, pair_b_.data(), vy);
}

// The loads of [[force]] at the midpoint. A rotating force turns by a fixed angle each step; its
// sine and cosine are taken anew every kResync steps, so that round-off does not gather.
template <class T>
void PaperKernel<T>::forces(std::int64_t k) {
  const double t = origin + (static_cast<double>(k) + 0.5) * step_;
  for (Force& force : forces_) {
    T x = force.x, y = force.y;
    if (force.rotating) {
      if (k % kResync == 0) {
        for (int lane = 0; lane < kLanes; ++lane) {
          const double angle = lanes::get(force.frequency, lane) * t + lanes::get(force.phase, lane);
          lanes::set(force.cosine, lane, std::cos(angle));
          lanes::set(force.sine, lane, std::sin(angle));
        }
      } else {
        const T c = force.cosine, s = force.sine;
        force.cosine = c * force.turn_cosine - s * force.turn_sine;
        force.sine = s * force.turn_cosine + c * force.turn_sine;
      }
      x = force.amplitude * force.cosine;
      y = force.amplitude * force.sine;
    }
    if (force.switched) {
      const T now = lanes::all<T>(t), one = lanes::all<T>(1.0), zero{};
      const T since = now - force.on;
      const T ramp = lanes::select(since < force.ramp, since / lanes::select(force.ramp > zero, force.ramp, one), one);
      const T envelope =
          lanes::select(now < force.on, zero, lanes::select(now < force.off, ramp, zero));
      x = x * envelope;
      y = y * envelope;
    }
    add_station(force.shape_x, force.shape_y, x, y);
  }
}

// m e (-sin, cos) at each disc's angle, summed over the modes: the rows of M that couple spin and
// bending, and (turned by -90 degrees) the direction of m e Omega^2.
template <class T>
void PaperKernel<T>::unbalance_arms(double t) {
  const auto n = static_cast<std::size_t>(layout_.modes);
  for (std::size_t k = 0; k < arm_x_.size(); ++k) arm_x_[k] = arm_y_[k] = T{};
  for (Unbalance& u : unbalances_) {
    T cosine{}, sine{};
    for (int lane = 0; lane < kLanes; ++lane) {
      const double spin = layout_.spin ? lanes::get(q_mid_[static_cast<std::size_t>(layout_.phi())], lane)
                                       : lanes::get(spin_angle_, lane) + lanes::get(speed_, lane) * t;
      const double angle = spin + lanes::get(u.phase, lane);
      lanes::set(cosine, lane, std::cos(angle));
      lanes::set(sine, lane, std::sin(angle));
    }
    u.cosine = cosine;
    u.sine = sine;
    if (!coupled_) continue;
    for (std::size_t k = 0; k < n; ++k) {
      arm_x_[k] -= u.moment * sine * u.shape_x[k];
      arm_y_[k] += u.moment * cosine * u.shape_y[k];
    }
  }
}

template <class T>
void PaperKernel<T>::unbalance_load(T omega) {
  for (const Unbalance& u : unbalances_) {
    const T size = u.moment * omega * omega;
    add_station(u.shape_x, u.shape_y, size * u.cosine, size * u.sine);
  }
}

template <class T>
void PaperKernel<T>::drive_torque() {
  if (drive_kind_ == scene::DriveKind::kFree) return;
  const T* v = v_new_.data();
  const auto phi = static_cast<std::size_t>(layout_.phi());
  T speed = v[phi];
  for (int k = 0; k < layout_.torsion; ++k) {
    speed += drive_shape_[static_cast<std::size_t>(k)] * v[layout_.theta() + k];
  }
  T torque = drive_gain_ * (drive_speed_ - speed);
  if (drive_kind_ != scene::DriveKind::kLinear) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const Drive& drive = *models_[static_cast<std::size_t>(lane)]->drive;
      const double omega = lanes::get(speed, lane);
      lanes::set(torque, lane, drive.torque(omega));
      const double slope = std::max(0.0, -drive.slope(omega));
      const double implicit = lanes::get(mass_[phi], lane) +
                              0.5 * step_ * (lanes::get(damping_[phi], lane) + slope);
      lanes::set(implicit_inverse_[phi], lane, 1.0 / implicit);
    }
    if (!coupled_) constant_implicit_ = admittance(implicit_inverse_.data());
  }
  f_[phi] += torque;
  for (int k = 0; k < layout_.torsion; ++k) {
    f_[static_cast<std::size_t>(layout_.theta() + k)] +=
        drive_shape_[static_cast<std::size_t>(k)] * torque;
  }
}

// f <- M^-1 f for the given diagonal, with the rows of unbalance eliminated.
template <class T>
void PaperKernel<T>::solve(const T* inverse, T* f) const {
  const int nq = layout_.nq(), n = layout_.modes;
  if (!coupled_) {
    for (int i = 0; i < nq; ++i) f[i] *= inverse[i];
    return;
  }
  const int phi = layout_.phi();
  T torque = f[phi], inertia = lanes::all<T>(1.0) / inverse[phi];
  for (int k = 0; k < n; ++k) {
    const T bx = arm_x_[static_cast<std::size_t>(k)], by = arm_y_[static_cast<std::size_t>(k)];
    torque -= bx * f[k] * inverse[k] + by * f[n + k] * inverse[n + k];
    inertia -= bx * bx * inverse[k] + by * by * inverse[n + k];
  }
  const T acceleration = torque / inertia;
  for (int k = 0; k < n; ++k) {
    f[k] -= arm_x_[static_cast<std::size_t>(k)] * acceleration;
    f[n + k] -= arm_y_[static_cast<std::size_t>(k)] * acceleration;
  }
  for (int i = 0; i < nq; ++i) f[i] *= inverse[i];
  f[phi] = acceleration;
}

template <class T>
auto PaperKernel<T>::admittance(const T* inverse) const -> Admittance {
  const int n = layout_.modes;
  Admittance a{};
  for (int k = 0; k < n; ++k) {
    const T cx = contact_x_[static_cast<std::size_t>(k)], cy = contact_y_[static_cast<std::size_t>(k)];
    a.xx += cx * cx * inverse[k];
    a.yy += cy * cy * inverse[n + k];
  }
  for (int k = 0; k < layout_.torsion; ++k) {
    const T c = torsion_contact_[static_cast<std::size_t>(k)];
    a.zz += c * c * inverse[layout_.theta() + k];
  }
  if (layout_.stator) {
    a.xx += inverse[layout_.ring()];
    a.yy += inverse[layout_.ring() + 1];
  }
  if (!coupled_) {
    if (layout_.spin) a.zz += inverse[layout_.phi()];
    return a;
  }
  // w = (-D^-1 b, 1), s = J - b^T D^-1 b: M^-1 = D0^-1 + w w^T / s.
  T s = lanes::all<T>(1.0) / inverse[layout_.phi()], wx{}, wy{};
  for (int k = 0; k < n; ++k) {
    const T bx = arm_x_[static_cast<std::size_t>(k)] * inverse[k];
    const T by = arm_y_[static_cast<std::size_t>(k)] * inverse[n + k];
    s -= arm_x_[static_cast<std::size_t>(k)] * bx + arm_y_[static_cast<std::size_t>(k)] * by;
    wx -= contact_x_[static_cast<std::size_t>(k)] * bx;
    wy -= contact_y_[static_cast<std::size_t>(k)] * by;
  }
  const T one_over = lanes::all<T>(1.0) / s;
  a.xx += wx * wx * one_over;
  a.yy += wy * wy * one_over;
  a.xy += wx * wy * one_over;
  a.xz += wx * one_over;
  a.yz += wy * one_over;
  a.zz += one_over;
  return a;
}

template <class T>
void PaperKernel<T>::free_velocity(std::int64_t k) {
  const int nq = layout_.nq(), n = layout_.modes;
  const double h = step_, t = origin + (static_cast<double>(k) + 0.5) * h;
  T *f = f_.data(), *v = v_new_.data();
  const T* q = q_mid_.data();
  for (int i = 0; i < nq; ++i) v[i] = v_[static_cast<std::size_t>(i)];
  const T omega = layout_.spin ? v[layout_.phi()] : speed_;
  if (rotates_) rotate(omega, 0.5 * h);
  for (int i = 0; i < nq; ++i) {
    const auto c = static_cast<std::size_t>(i);
    f[i] = -(stiffness_[c] * q[i] + damping_[c] * v[i]);
  }
  if (!weight_.empty()) {
    for (int i = 0; i < nq; ++i) f[i] += weight_[static_cast<std::size_t>(i)];
  }
  if (internal_xx_.kind != ModeMatrix::Kind::kAbsent) {
    const T minus = lanes::all<T>(-1.0);
    multiply(internal_xx_, minus, v, f, false);
    multiply(internal_yy_, minus, v + n, f + n, false);
    multiply(internal_xy_, -omega, q + n, f, false);
    multiply(internal_xy_, omega, q, f + n, true);
  }
  const auto at = [&](const Station& s, const T* x) {
    Centre r{};
    for (int i = 0; i < n; ++i) {
      r.x += s.shape_x[static_cast<std::size_t>(i)] * x[i];
      r.y += s.shape_y[static_cast<std::size_t>(i)] * x[n + i];
    }
    return r;
  };
  for (const Station& s : dampers_) {
    const Centre r = at(s, v);
    add_station(s.shape_x, s.shape_y, -s.factor_x * r.x, -s.factor_y * r.y);
  }
  for (const Station& s : springs_) {
    const Centre r = at(s, q);
    add_station(s.shape_x, s.shape_y, -s.factor_x * r.x, -s.factor_y * r.y);
  }
  forces(k);
  if (!unbalances_.empty()) {
    unbalance_arms(t);
    unbalance_load(omega);
  }
  if (layout_.spin) drive_torque();
  if (commanded && layout_.stator) {
    f[layout_.ring()] += command_x;
    f[layout_.ring() + 1] += command_y;
  }
  solve(implicit_inverse_.data(), f);
  const T step = lanes::all<T>(h);
  for (int i = 0; i < nq; ++i) v[i] += step * f[i];
  if (rotates_) rotate(layout_.spin ? v[layout_.phi()] : speed_, 0.5 * h);
}

}  // namespace rotorub
