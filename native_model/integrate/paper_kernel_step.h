// The step of a PaperKernel, all inline: whoever calls it chooses the instruction set.
#pragma once

#include <cmath>
#include <limits>

#include "native_model/integrate/paper_kernel_forces.h"

namespace rotorub {

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
  if (magnets_) {
    magnet_force();
  } else if (commanded && layout_.stator) {
    f[layout_.ring()] += command_x;
    f[layout_.ring() + 1] += command_y;
  }
  solve(implicit_inverse_.data(), f);
  const T step = lanes::all<T>(h);
  for (int i = 0; i < nq; ++i) v[i] += step * f[i];
  if (rotates_) rotate(layout_.spin ? v[layout_.phi()] : speed_, 0.5 * h);
}

}  // namespace rotorub
