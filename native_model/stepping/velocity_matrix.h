// The matrix that a fixed step solves with, A = M + h/2 D: D is the linear part of all forces that
// depend on velocities (damping of modes and bearings, rotating damping, the drive's slope,
// gyroscopics), taken at the speed of t = 0. So all of them are implicit at the middle of the step,
// whatever their size. What D leaves out (the spin's change, a motor's curve) is iterated
// (load_kick.h).
//
// A free spin with unbalance couples bending and spin by b(phi), the bending rows of M(phi)
// (equations::spin_coupling): A = A_0 + b e_phi^T + e_phi b^T, and bending is eliminated.
#pragma once

#include <vector>

#include "native_model/dynamics/equations.h"
#include "native_model/numerics/small_matrix.h"
#include "native_model/system/model.h"

namespace rotorub {

template <class T>
class VelocityMatrix {
 public:
  // One model a lane; step h, s.
  VelocityMatrix(const std::vector<const Model*>& models, double h);

  // h A^-1 where A is diagonal, nq values; else null.
  const T* diagonal_step() const {
    return dense_bending_ || dense_spin_ || coupled_ ? nullptr : step_.data();
  }
  bool coupled() const { return coupled_; }

  // b where the discs' directions are `at`. M: the model, as the caller knows its layout.
  template <class M>
  ROTORUB_INLINE void couple_at(const M& m, const equations::DiscAngles<T>& at) {
    const int n = m.layout.modes;
    T *b = coupling_.data(), *w = solved_.data();
    equations::spin_coupling(m, at, b, b + n);
    if (dense_bending_) {
      for (int k = 0; k < 2 * n; ++k) w[k] = T{};
      const T* of_disc = solved_shapes_.data();
      for (std::size_t i = 0; i < m.unbalances.size(); ++i, of_disc += 4 * n) {
        const T x = -m.unbalances[i].static_moment * at.sine[i];
        const T y = m.unbalances[i].static_moment * at.cosine[i];
        ROTORUB_APART for (int k = 0; k < 2 * n; ++k) w[k] +=
            x * of_disc[k] + y * of_disc[2 * n + k];
      }
    } else {
      for (int k = 0; k < 2 * n; ++k) w[k] = inverse_[static_cast<std::size_t>(k)] * b[k];
    }
    own_ = lanes::sum<T>(2 * n, [&](int k) { return b[k] * w[k]; });
    free_spin_ = lanes::all<T>(1.0) / (lanes::all<T>(1.0) - own_ * spin_column_[0]);
  }
  const T* coupling() const { return coupling_.data(); }  // b, two planes

  // f <- A^-1 f.
  template <class L>
  ROTORUB_INLINE void solve(const L& layout, T* f) {
    solve_uncoupled(layout, f);
    if (coupled_) couple(layout, f);
  }
  // f <- A_0^-1 f.
  template <class L>
  ROTORUB_INLINE void solve_uncoupled(const L& layout, T* f) {
    const int nq = layout.nq(), bending = 2 * layout.modes;
    const T* inverse = inverse_.data();
    if (!dense_bending_ && !dense_spin_) {
      ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] *= inverse[i];
      return;
    }
    T* work = work_.data();
    ROTORUB_APART for (int i = 0; i < nq; ++i) work[i] = f[i];
    int next = 0;
    if (dense_bending_) {
      small_matrix::multiply(bending_.data(), bending, bending, work, f);
      next = bending;
    }
    if (dense_spin_) {
      const int spins = layout.spin + layout.torsion;
      for (; next < bending; ++next) f[next] = inverse[next] * work[next];
      small_matrix::multiply(spin_.data(), spins, spins, work + bending, f + bending);
      next = bending + spins;
    }
    for (; next < nq; ++next) f[next] = inverse[next] * work[next];
  }
  // Of g with f = A_0^-1 g what A^-1 g has beside f: -w spin in bending, s back in the spin rows;
  // with w = B^-1 b, s = S^-1 e_phi the rows of unbalance are eliminated.
  struct Coupled {
    T spin{}, back{};
  };
  template <class L>
  ROTORUB_INLINE Coupled coupled_part(const L& layout, const T* f) const {
    const T* b = coupling_.data();
    const T load = lanes::sum<T>(2 * layout.modes, [&](int k) { return b[k] * f[k]; });
    const T spin = (f[layout.phi()] - spin_column_[0] * load) * free_spin_;
    return {spin, own_ * spin - load};
  }
  template <class L>
  ROTORUB_INLINE void add(const L& layout, const Coupled& part, T* f) const {
    const int bending = 2 * layout.modes, spins = layout.spin + layout.torsion;
    const T *w = solved_.data(), *column = spin_column_.data();
    ROTORUB_APART for (int k = 0; k < bending; ++k) f[k] -= w[k] * part.spin;
    for (int k = 0; k < spins; ++k) f[bending + k] += column[k] * part.back;
  }
  template <class L>
  ROTORUB_INLINE void couple(const L& layout, T* f) const {
    add(layout, coupled_part(layout, f), f);
  }
  const T* solved_coupling() const { return solved_.data(); }   // w
  const T* spin_column() const { return spin_column_.data(); }  // s

 private:
  bool dense_bending_ = false, dense_spin_ = false, coupled_ = false;
  lanes::Array<T> inverse_, step_;  // of the diagonal, nq; times h
  // Inverses of the blocks, column by column, where they are full: B^-1, S^-1.
  lanes::Array<T> bending_, spin_;
  // Where coupled: s; of each eccentric disc B^-1 times its mode values, of x and of y; b; w; b' w
  // and 1 / (1 - b' w s_phi).
  lanes::Array<T> spin_column_, solved_shapes_, coupling_, solved_;
  T own_{}, free_spin_ = lanes::all<T>(1.0);
  lanes::Array<T> work_;
};

}  // namespace rotorub
