// The loads of a PaperKernel's step, and its gyroscopic turn; all inline.
#pragma once

#include <cmath>

#include "native_model/bearing/actuator_axes.h"
#include "native_model/integrate/paper_kernel.h"
#include "native_model/system/actuation.h"

namespace rotorub {

inline constexpr std::int64_t kResync = 256;  // steps between exact sines of a rotating force

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

// F(s, i) on the ring at the midpoint, lane by lane, and what drives the coils.
template <class T>
void PaperKernel<T>::magnet_force() {
  const auto ring = static_cast<std::size_t>(layout_.ring());
  const auto coil = static_cast<std::size_t>(layout_.coil());
  for (int lane = 0; lane < kLanes; ++lane) {
    const MagneticActuator& magnets = *models_[static_cast<std::size_t>(lane)]->magnets;
    const auto of = [lane](const T& x) { return lanes::get(x, lane); };
    const Eigen::Vector2d asked{of(command_x), of(command_y)};
    Eigen::Vector2d current = asked;
    for (std::size_t k = 0; k < static_cast<std::size_t>(layout_.coils); ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      current[axis] = of(v_new_[coil + k]);
      lanes::set(f_[coil + k], lane,
                 of(f_[coil + k]) + coil_load(magnets, asked[axis], current[axis]));
    }
    const Eigen::Vector2d s = to_axes({of(q_mid_[ring]), of(q_mid_[ring + 1])});
    const Eigen::Vector2d force = from_axes(
        {magnets.law->force(s.x(), current.x()), magnets.law->force(s.y(), current.y())});
    lanes::set(f_[ring], lane, of(f_[ring]) + force.x());
    lanes::set(f_[ring + 1], lane, of(f_[ring + 1]) + force.y());
  }
}

}  // namespace rotorub
