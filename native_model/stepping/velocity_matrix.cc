#include "native_model/stepping/velocity_matrix.h"

#include <Eigen/Core>
#include <algorithm>

#include "native_model/dynamics/linear_parts.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/stepping/lane_model.h"

namespace rotorub {
namespace {

bool is_diagonal(const Eigen::MatrixXd& a) {
  return (a - Eigen::MatrixXd(a.diagonal().asDiagonal())).isZero(0.0);
}

template <class T>
void put_matrix(lanes::Array<T>& to, const Eigen::MatrixXd& from, int lane) {
  to.resize(static_cast<std::size_t>(from.size()), T{});
  put_lane(to, from.reshaped(), lane);
}

// D of one model, nq x nq, N s/m: -dF/dqdot at the speed of t = 0.
Eigen::MatrixXd linear_damping(const Model& m) {
  const Layout& l = m.layout;
  const int bending = 2 * l.modes;
  Eigen::MatrixXd d = m.damping.asDiagonal();
  d.topLeftCorner(bending, bending) = linear_parts(m, m.speed).damping;
  if (m.drive) {
    Eigen::VectorXd at_motor = Eigen::VectorXd::Zero(l.nq());
    at_motor[l.phi()] = 1.0;
    at_motor.segment(l.theta(), l.torsion) = m.drive_shape;
    // A motor's curve may rise with the speed: then the iteration has it alone.
    const double slope = std::max(0.0, -m.drive->slope(m.speed));
    d.noalias() += slope * at_motor * at_motor.transpose();
  }
  return d;
}

}  // namespace

template <class T>
VelocityMatrix<T>::VelocityMatrix(const std::vector<const Model*>& models, double h) {
  const Layout& l = models.front()->layout;
  const int nq = l.nq(), bending = 2 * l.modes, spins = l.spin + l.torsion;
  coupled_ = models.front()->coupled_mass();
  std::vector<Eigen::MatrixXd> all;
  for (const Model* m : models) {
    all.push_back(0.5 * h * linear_damping(*m));
    const Eigen::MatrixXd& d = all.back();
    dense_bending_ = dense_bending_ || !is_diagonal(d.topLeftCorner(bending, bending));
    dense_spin_ = dense_spin_ || !is_diagonal(d.block(l.phi(), l.phi(), spins, spins));
  }
  for (auto* x : {&inverse_, &step_, &work_}) x->assign(static_cast<std::size_t>(nq), T{});
  if (coupled_) coupling_.assign(static_cast<std::size_t>(bending), T{});
  solved_ = coupling_;
  for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
    const Model& m = *models[static_cast<std::size_t>(lane)];
    const Eigen::MatrixXd& d = all[static_cast<std::size_t>(lane)];
    const Eigen::MatrixXd a = Eigen::MatrixXd(m.mass.asDiagonal()) + d;
    const Eigen::VectorXd inverse = a.diagonal().cwiseInverse();
    put_lane(inverse_, inverse, lane);
    put_lane(step_, Eigen::VectorXd(h * inverse), lane);
    const Eigen::MatrixXd bend = lu_inverse(Eigen::MatrixXd(a.topLeftCorner(bending, bending)));
    if (dense_bending_) put_matrix(bending_, bend, lane);
    if (!l.spin) continue;
    const Eigen::MatrixXd turn =
        lu_inverse(Eigen::MatrixXd(a.block(l.phi(), l.phi(), spins, spins)));
    if (dense_spin_) put_matrix(spin_, turn, lane);
    if (!coupled_) continue;
    put_matrix(spin_column_, turn.leftCols(1), lane);
    Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(bending, 2 * m.unbalances.size());
    for (std::size_t i = 0; i < m.unbalances.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(2 * i);
      shapes.col(column).head(l.modes) = m.unbalances[i].shape.x;
      shapes.col(column + 1).tail(l.modes) = m.unbalances[i].shape.y;
    }
    put_matrix(solved_shapes_, bend * shapes, lane);
  }
}

template class VelocityMatrix<double>;
template class VelocityMatrix<lanes::Lane<2>>;
template class VelocityMatrix<lanes::Lane<4>>;
template class VelocityMatrix<lanes::Lane<8>>;

}  // namespace rotorub
