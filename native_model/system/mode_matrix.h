// A matrix between the bending modes of two planes that costs what it is: absent, diagonal or full.
#pragma once

#include <Eigen/Core>
#include <vector>

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

  // out += factor * A * in, n values each. Plain loops: n is small, and nothing may allocate.
  void add(double factor, const double* in, double* out, int n) const {
    const double* a = values_.data();
    if (kind_ == Kind::kDiagonal) {
      for (int i = 0; i < n; ++i) out[i] += factor * a[i] * in[i];
    } else if (kind_ == Kind::kFull) {
      for (int i = 0; i < n; ++i) {
        double sum = 0.0;
        for (int j = 0; j < n; ++j) sum += a[i * n + j] * in[j];
        out[i] += factor * sum;
      }
    }
  }
  // out += factor * A^T * in.
  void add_transposed(double factor, const double* in, double* out, int n) const {
    if (kind_ != Kind::kFull) return add(factor, in, out, n);
    const double* a = values_.data();
    for (int i = 0; i < n; ++i) {
      const double scaled = factor * in[i];
      for (int j = 0; j < n; ++j) out[j] += a[i * n + j] * scaled;
    }
  }

 private:
  Kind kind_ = Kind::kAbsent;
  std::vector<double> values_;  // the diagonal, or row by row
};

}  // namespace rotorub
