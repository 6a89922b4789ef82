// A matrix between the bending modes of two planes. It is stored as absent, diagonal or full, so
// that its cost matches its content.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/numerics/small_matrix.h"

namespace rotorub {

class ModeMatrix {
 public:
  enum class Kind { kAbsent, kDiagonal, kFull };

  ModeMatrix() = default;
  // n x n; exact zeros decide the kind.
  explicit ModeMatrix(const Eigen::MatrixXd& matrix);

  Kind kind() const { return kind_; }
  bool absent() const { return kind_ == Kind::kAbsent; }
  Eigen::MatrixXd dense(int n) const;

  // out += factor * A * in, n values each.
  void add(double factor, const double* in, double* out, int n) const {
    const double* a = columns_.data();
    if (kind_ == Kind::kDiagonal) {
      for (int i = 0; i < n; ++i) out[i] += factor * a[i] * in[i];
    } else if (kind_ == Kind::kFull) {
      small_matrix::add_multiple(factor, a, n, n, in, out);
    }
  }
  // out += factor * A^T * in.
  void add_transposed(double factor, const double* in, double* out, int n) const {
    if (rows_.empty()) return add(factor, in, out, n);
    small_matrix::add_multiple(factor, rows_.data(), n, n, in, out);
  }

 private:
  Kind kind_ = Kind::kAbsent;
  std::vector<double> columns_;  // the diagonal, or all columns
  std::vector<double> rows_;     // all rows of a full matrix that is not symmetric
};

}  // namespace rotorub
