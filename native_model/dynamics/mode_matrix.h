// A matrix between the bending modes of two planes that costs what it is: absent, diagonal or full.
// T: double, or a vector of runs side by side (numerics/lanes.h).
#pragma once

#include <Eigen/Core>

#include "native_model/numerics/lanes.h"

namespace rotorub {

template <class T>
class BasicModeMatrix {
 public:
  enum class Kind { kAbsent, kDiagonal, kFull };

  BasicModeMatrix() = default;
  // n x n; exact zeros decide the kind.
  explicit BasicModeMatrix(const Eigen::MatrixXd& matrix);
  // n x n of the given kind, row by row or the diagonal alone.
  BasicModeMatrix(Kind kind, lanes::Array<T> values) : kind_(kind), values_(std::move(values)) {}

  Kind kind() const { return kind_; }
  bool absent() const { return kind_ == Kind::kAbsent; }
  Eigen::MatrixXd dense(int n) const;

  // out += factor * A * in, n values each. Plain loops: n is small, and nothing may allocate.
  ROTORUB_INLINE void add(const T& factor, const T* in, T* out, int n) const {
    const T* a = values_.data();
    if (kind_ == Kind::kDiagonal) {
      for (int i = 0; i < n; ++i) out[i] += factor * a[i] * in[i];
    } else if (kind_ == Kind::kFull) {
      for (int i = 0; i < n; ++i) {
        T sum{};
        for (int j = 0; j < n; ++j) sum += a[i * n + j] * in[j];
        out[i] += factor * sum;
      }
    }
  }
  // out += factor * A^T * in.
  ROTORUB_INLINE void add_transposed(const T& factor, const T* in, T* out, int n) const {
    if (kind_ != Kind::kFull) return add(factor, in, out, n);
    const T* a = values_.data();
    for (int i = 0; i < n; ++i) {
      const T scaled = factor * in[i];
      for (int j = 0; j < n; ++j) out[j] += a[i * n + j] * scaled;
    }
  }

 private:
  Kind kind_ = Kind::kAbsent;
  lanes::Array<T> values_;  // the diagonal, or row by row
};

using ModeMatrix = BasicModeMatrix<double>;
template <>
ModeMatrix::BasicModeMatrix(const Eigen::MatrixXd& matrix);
template <>
Eigen::MatrixXd ModeMatrix::dense(int n) const;

}  // namespace rotorub
