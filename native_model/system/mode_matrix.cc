#include "native_model/system/mode_matrix.h"

namespace rotorub {

ModeMatrix::ModeMatrix(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0 || (matrix.array() == 0.0).all()) return;
  const Eigen::MatrixXd off = matrix - Eigen::MatrixXd(matrix.diagonal().asDiagonal());
  if ((off.array() == 0.0).all()) {
    kind_ = Kind::kDiagonal;
    diagonal_ = matrix.diagonal();
  } else {
    kind_ = Kind::kFull;
    full_ = matrix;
  }
}

Eigen::MatrixXd ModeMatrix::dense(int n) const {
  switch (kind_) {
    case Kind::kAbsent: return Eigen::MatrixXd::Zero(n, n);
    case Kind::kDiagonal: return diagonal_.asDiagonal();
    case Kind::kFull: return full_;
  }
  return {};
}

}  // namespace rotorub
