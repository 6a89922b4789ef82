// The matrix that a fixed step solves with, A = M + h/2 D: D is the linear part of all forces that
// depend on velocities (damping of modes and bearings, rotating damping, the drive's slope,
// gyroscopics), taken at the speed of t = 0. So all of them are implicit at the middle of the step,
// whatever their size. What D leaves out (the spin's change, a motor's curve) is iterated
// (load_kick.h).
#pragma once

#include <vector>

#include "native_model/numerics/lanes.h"
#include "native_model/system/model.h"

namespace rotorub {

template <class T>
class VelocityMatrix {
 public:
  // One model a lane; step h, s.
  VelocityMatrix(const std::vector<const Model*>& models, double h);

  // h A^-1 where A is diagonal, nq values; else null.
  const T* diagonal_step() const { return dense_bending_ || dense_spin_ ? nullptr : step_.data(); }

  // f <- A^-1 f. With a coupled mass bx, by are the bending rows of M(phi)
  // (equations::spin_coupling): A = A_0 + b e_phi^T + e_phi b^T, and bending is eliminated. Null:
  // not coupled. `layout`: the model's, as the caller knows it.
  template <class L>
  ROTORUB_INLINE void solve(const L& layout, const T* bx, const T* by, T* f) {
    const int nq = layout.nq();
    const T* inverse = inverse_.data();
    if (!dense_bending_ && !dense_spin_ && !bx) {
      for (int i = 0; i < nq; ++i) f[i] *= inverse[i];
      return;
    }
    bend(f, f);
    for (int i = layout.phi(); i < nq; ++i) {
      if (i < layout.phi() + spins() && dense_spin_) continue;
      f[i] *= inverse[i];
    }
    if (dense_spin_) multiply(spin_.data(), spins(), f + layout_.phi(), f + layout_.phi());
    if (bx) couple(bx, by, f);
  }

 private:
  int spins() const { return layout_.spin + layout_.torsion; }

  // out = A x for a square matrix, row by row; may be in place.
  ROTORUB_INLINE void multiply(const T* a, int n, const T* in, T* out) {
    T* work = work_.data();
    for (int i = 0; i < n; ++i) {
      T sum{};
      for (int j = 0; j < n; ++j) sum += a[i * n + j] * in[j];
      work[i] = sum;
    }
    for (int i = 0; i < n; ++i) out[i] = work[i];
  }
  // The bending block.
  ROTORUB_INLINE void bend(const T* in, T* out) {
    const int n = 2 * layout_.modes;
    if (dense_bending_) return multiply(bending_.data(), n, in, out);
    for (int i = 0; i < n; ++i) out[i] = inverse_[static_cast<std::size_t>(i)] * in[i];
  }
  // f holds A_0^-1 f: with w = B^-1 b, s = S^-1 e_phi the rows of unbalance are eliminated.
  ROTORUB_INLINE void couple(const T* bx, const T* by, T* f) {
    const int n = layout_.modes, phi = layout_.phi();
    T *b = rows_.data(), *w = solved_.data();
    for (int k = 0; k < n; ++k) {
      b[k] = bx[k];
      b[n + k] = by[k];
    }
    bend(b, w);
    T own{}, load{};
    for (int k = 0; k < 2 * n; ++k) {
      own += b[k] * w[k];
      load += b[k] * f[k];
    }
    const T one = lanes::all<T>(1.0);
    const auto column = [&](int k) {
      return dense_spin_ ? spin_[static_cast<std::size_t>(k * spins())]
                         : (k == 0 ? inverse_[static_cast<std::size_t>(phi)] : T{});
    };
    const T spin = (f[phi] - column(0) * load) / (one - own * column(0));
    for (int k = 0; k < spins(); ++k) f[phi + k] += column(k) * (own * spin - load);
    for (int k = 0; k < 2 * n; ++k) f[k] -= w[k] * spin;
  }

  Layout layout_;
  bool dense_bending_ = false, dense_spin_ = false;
  lanes::Array<T> inverse_, step_;  // of the diagonal, nq; times h
  lanes::Array<T> bending_, spin_;  // inverses of the blocks, row by row, where they are full
  lanes::Array<T> work_, rows_, solved_;
};

}  // namespace rotorub
