#include "native_model/integrate/gyroscopic_rotation.h"

#include <Eigen/SVD>
#include <cmath>

namespace rotorub {

GyroscopicRotation::GyroscopicRotation(const Model& model)
    : modes_(model.layout.modes), x_(model.layout.x()), y_(model.layout.y()) {
  if (model.gyroscopic.absent()) return;
  const Eigen::VectorXd root_x = model.mass.segment(x_, modes_).cwiseSqrt();
  const Eigen::VectorXd root_y = model.mass.segment(y_, modes_).cwiseSqrt();
  const Eigen::MatrixXd scaled = root_x.cwiseInverse().asDiagonal() *
                                 model.gyroscopic.dense(modes_) *
                                 root_y.cwiseInverse().asDiagonal();
  diagonal_ = model.gyroscopic.kind() == ModeMatrix::Kind::kDiagonal;
  if (diagonal_) {
    rates_ = scaled.diagonal();
    scale_ = root_y.cwiseQuotient(root_x);
    return;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
  rates_ = svd.singularValues();
  to_x_ = svd.matrixU().transpose() * root_x.asDiagonal();
  to_y_ = svd.matrixV().transpose() * root_y.asDiagonal();
  from_x_ = root_x.cwiseInverse().asDiagonal() * svd.matrixU();
  from_y_ = root_y.cwiseInverse().asDiagonal() * svd.matrixV();
  a_ = b_ = Eigen::VectorXd::Zero(modes_);
}

void GyroscopicRotation::apply(double omega, double h, double* v) {
  // a' = -w b, b' = +w a with w = S Omega: (a, b) turns by w h.
  const auto turn = [omega, h](double rate, double& a, double& b) {
    const double tau = 0.5 * rate * omega * h, factor = 1.0 / (1.0 + tau * tau);
    const double c = (1.0 - tau * tau) * factor, s = 2.0 * tau * factor, a0 = a;
    a = c * a0 - s * b;
    b = s * a0 + c * b;
  };
  if (diagonal_) {
    for (int k = 0; k < modes_; ++k) {
      double a = v[x_ + k], b = v[y_ + k] * scale_[k];
      turn(rates_[k], a, b);
      v[x_ + k] = a;
      v[y_ + k] = b / scale_[k];
    }
    return;
  }
  Eigen::Map<Eigen::VectorXd> vx(v + x_, modes_), vy(v + y_, modes_);
  a_.noalias() = to_x_ * vx;
  b_.noalias() = to_y_ * vy;
  for (int k = 0; k < modes_; ++k) turn(rates_[k], a_[k], b_[k]);
  vx.noalias() = from_x_ * a_;
  vy.noalias() = from_y_ * b_;
}

}  // namespace rotorub
