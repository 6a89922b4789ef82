// A matrix between the bending modes of two planes that costs what it is: absent, diagonal or full.
#pragma once

#include <Eigen/Core>

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
    switch (kind_) {
      case Kind::kAbsent: return;
      case Kind::kDiagonal:
        for (int i = 0; i < n; ++i) out[i] += factor * diagonal_[i] * in[i];
        return;
      case Kind::kFull:
        Eigen::Map<Eigen::VectorXd>(out, n).noalias() +=
            factor * (full_ * Eigen::Map<const Eigen::VectorXd>(in, n));
        return;
    }
  }
  // out += factor * A^T * in.
  void add_transposed(double factor, const double* in, double* out, int n) const {
    if (kind_ != Kind::kFull) return add(factor, in, out, n);
    Eigen::Map<Eigen::VectorXd>(out, n).noalias() +=
        factor * (full_.transpose() * Eigen::Map<const Eigen::VectorXd>(in, n));
  }

 private:
  Kind kind_ = Kind::kAbsent;
  Eigen::VectorXd diagonal_;
  Eigen::MatrixXd full_;
};

}  // namespace rotorub
