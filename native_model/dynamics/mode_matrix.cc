#include "native_model/dynamics/mode_matrix.h"

namespace rotorub {

template <>
ModeMatrix::BasicModeMatrix(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0 || (matrix.array() == 0.0).all()) return;
  const Eigen::MatrixXd off = matrix - Eigen::MatrixXd(matrix.diagonal().asDiagonal());
  if ((off.array() == 0.0).all()) {
    kind_ = Kind::kDiagonal;
    values_.assign(matrix.diagonal().begin(), matrix.diagonal().end());
    return;
  }
  kind_ = Kind::kFull;
  for (const auto row : matrix.rowwise()) values_.insert(values_.end(), row.begin(), row.end());
}

template <>
Eigen::MatrixXd ModeMatrix::dense(int n) const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  switch (kind_) {
    case Kind::kAbsent:
      return Eigen::MatrixXd::Zero(n, n);
    case Kind::kDiagonal:
      return Eigen::Map<const Eigen::VectorXd>(values_.data(), n).asDiagonal();
    case Kind::kFull:
      return Eigen::Map<const RowMajor>(values_.data(), n, n);
  }
  return {};
}

}  // namespace rotorub
