#include "native_model/model/mode_matrix.h"

namespace rotorub {

ModeMatrix::ModeMatrix(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0 || (matrix.array() == 0.0).all()) return;
  const Eigen::MatrixXd off = matrix - Eigen::MatrixXd(matrix.diagonal().asDiagonal());
  if ((off.array() == 0.0).all()) {
    kind_ = Kind::kDiagonal;
    columns_.assign(matrix.diagonal().begin(), matrix.diagonal().end());
    return;
  }
  kind_ = Kind::kFull;
  const auto columns = matrix.reshaped();
  columns_.assign(columns.begin(), columns.end());
  if (matrix == matrix.transpose()) return;
  const auto rows = matrix.reshaped<Eigen::RowMajor>();
  rows_.assign(rows.begin(), rows.end());
}

Eigen::MatrixXd ModeMatrix::dense(int n) const {
  switch (kind_) {
    case Kind::kAbsent:
      return Eigen::MatrixXd::Zero(n, n);
    case Kind::kDiagonal:
      return Eigen::Map<const Eigen::VectorXd>(columns_.data(), n).asDiagonal();
    case Kind::kFull:
      return Eigen::Map<const Eigen::MatrixXd>(columns_.data(), n, n);
  }
  return {};
}

}  // namespace rotorub
