#include "native_model/stepping/velocity_matrix.h"

#include <Eigen/Core>
#include <algorithm>

#include "native_model/model/linear_parts.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/numerics/small_matrix.h"

namespace rotorub {
namespace {

std::vector<double> numbers(const Eigen::MatrixXd& of) {
  const auto columns = of.reshaped();
  return {columns.begin(), columns.end()};
}

// D, nq x nq, N s/m: -dF/dqdot at the speed of t = 0.
Eigen::MatrixXd linear_damping(const Model& m) {
  const Layout& l = m.layout;
  const int bending = 2 * l.modes;
  Eigen::MatrixXd d = m.damping.asDiagonal();
  d.topLeftCorner(bending, bending) = linear_parts(m, m.speed).damping;
  if (m.drive) {
    Eigen::VectorXd at_motor = Eigen::VectorXd::Zero(l.nq());
    at_motor[l.phi()] = 1.0;
    at_motor.segment(l.theta(), l.torsion) = m.drive_shape;
    // The curve of a motor may rise with the speed; then only the iteration contains it.
    const double slope = std::max(0.0, -m.drive->slope(m.speed));
    d.noalias() += slope * at_motor * at_motor.transpose();
  }
  return d;
}

}  // namespace

VelocityMatrix::VelocityMatrix(const Model& m, double h) : model_(&m), coupled_(m.coupled_mass()) {
  const Layout& l = m.layout;
  const int bending = 2 * l.modes, spins = l.spin + l.torsion;
  const Eigen::MatrixXd d = 0.5 * h * linear_damping(m);
  const Eigen::MatrixXd a = Eigen::MatrixXd(m.mass.asDiagonal()) + d;
  dense_bending_ = !d.topLeftCorner(bending, bending).isDiagonal(0.0);
  dense_spin_ = !d.block(l.phi(), l.phi(), spins, spins).isDiagonal(0.0);
  const Eigen::VectorXd inverse = a.diagonal().cwiseInverse();
  inverse_ = numbers(inverse);
  step_ = numbers(h * inverse);
  work_.resize(inverse_.size());
  const Eigen::MatrixXd bend = lu_inverse(Eigen::MatrixXd(a.topLeftCorner(bending, bending)));
  if (dense_bending_) bending_ = numbers(bend);
  if (!l.spin) return;
  const Eigen::MatrixXd turn = lu_inverse(Eigen::MatrixXd(a.block(l.phi(), l.phi(), spins, spins)));
  if (dense_spin_) spin_ = numbers(turn);
  if (!coupled_) return;
  coupling_.resize(static_cast<std::size_t>(bending));
  solved_ = coupling_;
  spin_column_ = numbers(turn.leftCols(1));
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(bending, 2 * std::ssize(m.unbalances));
  for (Eigen::Index i = 0; i < std::ssize(m.unbalances); ++i) {
    const ModeShape& shape = m.unbalances[static_cast<std::size_t>(i)].shape;
    shapes.col(2 * i).head(l.modes) = shape.x;
    shapes.col(2 * i + 1).tail(l.modes) = shape.y;
  }
  solved_shapes_ = numbers(bend * shapes);
}

void VelocityMatrix::couple_at(const equations::DiscAngles& at) {
  ++times_coupled_;
  const Model& m = *model_;
  const int n = m.layout.modes;
  double *b = coupling_.data(), *w = solved_.data();
  equations::spin_coupling(m, at, b, b + n);
  if (dense_bending_) {
    for (int k = 0; k < 2 * n; ++k) w[k] = 0.0;
    const double* of_disc = solved_shapes_.data();
    for (std::size_t i = 0; i < m.unbalances.size(); ++i, of_disc += 4 * n) {
      const double x = -m.unbalances[i].static_moment * at.sine[i];
      const double y = m.unbalances[i].static_moment * at.cosine[i];
      ROTORUB_APART for (int k = 0; k < 2 * n; ++k) w[k] += x * of_disc[k] + y * of_disc[2 * n + k];
    }
  } else {
    const double* inverse = inverse_.data();
    ROTORUB_APART for (int k = 0; k < 2 * n; ++k) w[k] = inverse[k] * b[k];
  }
  own_ = sum(2 * n, [=](int k) { return b[k] * w[k]; });
  free_spin_ = 1.0 / (1.0 - own_ * spin_column_[0]);
}

void VelocityMatrix::solve_uncoupled(double* f) {
  const Layout& l = model_->layout;
  const int nq = l.nq(), bending = 2 * l.modes;
  const double* inverse = inverse_.data();
  if (!dense_bending_ && !dense_spin_) {
    ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] *= inverse[i];
    return;
  }
  double* work = work_.data();
  ROTORUB_APART for (int i = 0; i < nq; ++i) work[i] = f[i];
  int next = 0;
  if (dense_bending_) {
    small_matrix::multiply(bending_.data(), bending, bending, work, f);
    next = bending;
  }
  if (dense_spin_) {
    const int spins = l.spin + l.torsion;
    for (; next < bending; ++next) f[next] = inverse[next] * work[next];
    small_matrix::multiply(spin_.data(), spins, spins, work + bending, f + bending);
    next = bending + spins;
  }
  for (; next < nq; ++next) f[next] = inverse[next] * work[next];
}

VelocityMatrix::Coupled VelocityMatrix::coupled_part(const double* f) const {
  const Layout& l = model_->layout;
  const double* b = coupling_.data();
  const double load = sum(2 * l.modes, [=](int k) { return b[k] * f[k]; });
  const double spin = (f[l.phi()] - spin_column_[0] * load) * free_spin_;
  return {spin, own_ * spin - load};
}

void VelocityMatrix::add(const Coupled& part, double* f) const {
  const Layout& l = model_->layout;
  const int bending = 2 * l.modes, spins = l.spin + l.torsion;
  const double *w = solved_.data(), *column = spin_column_.data();
  ROTORUB_APART for (int k = 0; k < bending; ++k) f[k] -= w[k] * part.spin;
  for (int k = 0; k < spins; ++k) f[bending + k] += column[k] * part.back;
}

}  // namespace rotorub
