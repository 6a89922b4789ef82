// A matrix between the bending modes of two planes that costs what it is: absent, diagonal or full.
// T: double, or a vector of runs side by side (numerics/lanes.h).
#pragma once

#include <Eigen/Core>

#include "native_model/numerics/small_matrix.h"

namespace rotorub {

template <class T>
class BasicModeMatrix {
 public:
  enum class Kind { kAbsent, kDiagonal, kFull };

  BasicModeMatrix() = default;
  // n x n; exact zeros decide the kind.
  explicit BasicModeMatrix(const Eigen::MatrixXd& matrix);
  // n x n of the given kind, column by column or the diagonal alone.
  BasicModeMatrix(Kind kind, lanes::Array<T> values, int n)
      : kind_(kind), columns_(std::move(values)) {
    if (kind_ != Kind::kFull || symmetric(n)) return;
    rows_ = columns_;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) rows_[at(i * n + j)] = columns_[at(j * n + i)];
    }
  }

  Kind kind() const { return kind_; }
  bool absent() const { return kind_ == Kind::kAbsent; }
  Eigen::MatrixXd dense(int n) const;

  // out += factor * A * in, n values each.
  ROTORUB_INLINE void add(const T& factor, const T* in, T* out, int n) const {
    const T* a = columns_.data();
    if (kind_ == Kind::kDiagonal) {
      for (int i = 0; i < n; ++i) out[i] += factor * a[i] * in[i];
    } else if (kind_ == Kind::kFull) {
      small_matrix::add_multiple(factor, a, n, n, in, out);
    }
  }
  // out += factor * A^T * in.
  ROTORUB_INLINE void add_transposed(const T& factor, const T* in, T* out, int n) const {
    if (rows_.empty()) return add(factor, in, out, n);
    small_matrix::add_multiple(factor, rows_.data(), n, n, in, out);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  bool symmetric(int n) const {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) {
        if (lanes::any(columns_[at(i * n + j)] != columns_[at(j * n + i)])) return false;
      }
    }
    return true;
  }

  Kind kind_ = Kind::kAbsent;
  lanes::Array<T> columns_;  // the diagonal, or column by column
  lanes::Array<T> rows_;     // row by row, of one that is full and not symmetric
};

using ModeMatrix = BasicModeMatrix<double>;
template <>
ModeMatrix::BasicModeMatrix(const Eigen::MatrixXd& matrix);
template <>
Eigen::MatrixXd ModeMatrix::dense(int n) const;

}  // namespace rotorub
