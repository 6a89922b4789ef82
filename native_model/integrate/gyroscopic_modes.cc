#include "native_model/integrate/gyroscopic_modes.h"

#include <Eigen/SVD>

namespace rotorub {

GyroscopicModes gyroscopic_modes(const Model& model) {
  GyroscopicModes modes;
  if (model.gyroscopic.absent()) return modes;
  const int n = model.layout.modes;
  const Eigen::VectorXd root_x = model.mass.segment(model.layout.x(), n).cwiseSqrt();
  const Eigen::VectorXd root_y = model.mass.segment(model.layout.y(), n).cwiseSqrt();
  const Eigen::MatrixXd scaled = root_x.cwiseInverse().asDiagonal() * model.gyroscopic.dense(n) *
                                 root_y.cwiseInverse().asDiagonal();
  Eigen::MatrixXd u = Eigen::MatrixXd::Identity(n, n), v = u;
  modes.diagonal = model.gyroscopic.kind() == ModeMatrix::Kind::kDiagonal;
  if (modes.diagonal) {
    modes.rate = scaled.diagonal();
  } else {
    // Square: nothing to reduce by a QR first, and none to compile.
    const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(
        scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
    modes.rate = svd.singularValues();
    u = svd.matrixU();
    v = svd.matrixV();
  }
  modes.to_x = u.transpose() * root_x.asDiagonal();
  modes.to_y = v.transpose() * root_y.asDiagonal();
  modes.from_x = root_x.cwiseInverse().asDiagonal() * u;
  modes.from_y = root_y.cwiseInverse().asDiagonal() * v;
  return modes;
}

}  // namespace rotorub
