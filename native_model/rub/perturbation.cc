#include "native_model/rub/perturbation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/rotor/refusal.h"

namespace rotorub::rub {
namespace {

// [Re A, -Im A; Im A, Re A]: A on (Re y, Im y).
Eigen::MatrixXd real_form(const Eigen::MatrixXcd& A) {
  const Eigen::Index n = A.rows();
  Eigen::MatrixXd R(2 * n, 2 * n);
  R << A.real(), -A.imag(), A.imag(), A.real();
  return R;
}
Eigen::VectorXd real_form(const Eigen::VectorXcd& a) {
  Eigen::VectorXd r(2 * a.size());
  r << a.real(), a.imag();
  return r;
}

// (a, b) together: masses, rates and springs in the turning frame, and c^T a - b = normal^T (a, b).
struct Joint {
  Eigen::VectorXd mass, normal;
  Eigen::MatrixXcd rates, springs;
};

Joint joint(const RubSystem& s, double nu) {
  const Eigen::Index n = s.modes(), all = n + (s.ring ? 1 : 0);
  Joint j{Eigen::VectorXd(all), Eigen::VectorXd(all), Eigen::MatrixXcd::Zero(all, all),
          Eigen::MatrixXcd::Zero(all, all)};
  j.mass.head(n) = s.mass;
  j.normal.head(n) = s.contact;
  j.rates.topLeftCorner(n, n) = rotor_rates(s);
  j.springs.topLeftCorner(n, n) = dynamic_stiffness(s, nu);
  if (s.ring) {
    j.mass[n] = s.ring->mass;
    j.normal[n] = -1.0;
    j.rates(n, n) = s.ring->rate();
    j.springs(n, n) = ring_stiffness(s, nu);
  }
  j.rates.diagonal() += (2.0 * kI * nu) * j.mass.cast<Complex>();
  return j;
}

}  // namespace

Eigen::MatrixXcd rotor_rates(const RubSystem& s) {
  return (s.damping + s.internal).cast<Complex>() - (kI * s.speed) * s.gyroscopic.cast<Complex>();
}

Eigen::MatrixXcd rotor_springs(const RubSystem& s) {
  return s.stiffness.cast<Complex>() - (kI * s.speed) * s.internal.cast<Complex>();
}

Eigen::MatrixXd complement(const Eigen::MatrixXd& directions) {
  const Eigen::Index n = directions.rows();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(directions);
  return qr.householderQ() * Eigen::MatrixXd::Identity(n, n).rightCols(n - directions.cols());
}

Perturbation perturbation(const RubSystem& s, const SteadyRub& rub) {
  const Joint j = joint(s, rub.whirl);
  const Eigen::Index n = j.mass.size();
  Perturbation p{
      Eigen::MatrixXd::Zero(2 * n, 2 * n), real_form(j.rates), real_form(j.springs), {}, {}};
  p.mass.diagonal() << j.mass, j.mass;
  if (rub.kind == RubKind::kRolling) {  // c^T a = b, and the force points anywhere
    p.constraint = Eigen::MatrixXd::Zero(2, 2 * n);
    p.constraint.row(0).head(n) = j.normal;
    p.constraint.row(1).tail(n) = j.normal;
    p.push = p.constraint.transpose();
    return p;
  }
  p.constraint = Eigen::MatrixXd::Zero(1, 2 * n);
  p.constraint.row(0).head(n) = j.normal;
  const Eigen::VectorXcd push = Complex(1.0, rub.friction) * j.normal.cast<Complex>();
  p.push = real_form(push);
  // The force turns with the contact: eps = Im(c^T a - b) / delta_0.
  p.springs.rightCols(n) += (rub.normal_force / s.clearance) *
                            real_form(Eigen::VectorXcd(kI * push)) * j.normal.transpose();
  return p;
}

std::vector<Complex> eigenvalues(const Perturbation& p) {
  const Eigen::Index n = p.mass.rows();
  // Coordinates of unit mass, y = root^-T u.
  const Eigen::LLT<Eigen::MatrixXd> root(p.mass);
  if (root.info() != Eigen::Success)
    throw RotorNotSolvable("no eigenvalues of its rub can be found");
  const Eigen::MatrixXd scale = root.matrixL().solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd K = scale * p.springs * scale.transpose();
  const Eigen::MatrixXd B = scale * p.rates * scale.transpose();
  const Eigen::MatrixXd F = scale * p.push, C = p.constraint * scale.transpose();

  // On the constraint: u = Z w, and l = -(C F)^-1 C (K u + B u').
  const Eigen::MatrixXd Z = complement(C.transpose());
  const Eigen::MatrixXd met = C * F;
  // Unbalance makes friction move the normal: beyond some friction the force would pull (Painleve).
  if (!(met.determinant() > 0.0)) throw RotorNotSolvable("no eigenvalues of its rub can be found");
  const Eigen::MatrixXd along =
      Z.transpose() - (Z.transpose() * F) * Eigen::MatrixXd(met.inverse()) * C;
  const Eigen::MatrixXd rates = along * B * Z, springs = along * K * Z;
  const auto values = real_eigenvalues(first_order_form(rates, springs, frequency_scale(springs)));
  if (!values) throw RotorNotSolvable("no eigenvalues of its rub can be found");
  return *values;
}

void leave_out_smallest(std::vector<Complex>& values, int count) {
  const auto smaller = [](const Complex& a, const Complex& b) { return std::abs(a) < std::abs(b); };
  for (int k = 0; k < count && !values.empty(); ++k) {
    values.erase(std::min_element(values.begin(), values.end(), smaller));
  }
}

}  // namespace rotorub::rub
