#include "native_model/linear/rub_stability.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/rotor/refusal.h"

namespace rotorub::rub {
namespace {

// [Re A, -Im A; Im A, Re A], the action of A on (Re y, Im y).
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

// D + N - i Omega G, N s/m, and K - i Omega N, N/m, in the inertial frame, n x n.
Eigen::MatrixXcd rotor_rates(const RubSystem& s) {
  return (s.damping + s.internal).cast<Complex>() - (kI * s.speed) * s.gyroscopic.cast<Complex>();
}
Eigen::MatrixXcd rotor_springs(const RubSystem& s) {
  return s.stiffness.cast<Complex>() - (kI * s.speed) * s.internal.cast<Complex>();
}

// Rotor and ring (a, b) together: masses, rates and springs in the rotating frame, and
// c^T a - b = normal^T (a, b).
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

constexpr const char* kNotFound = "no eigenvalues of its rub can be found";

// s of s^2 M + s B + C, M real and positive definite.
std::vector<Complex> quadratic(const Eigen::MatrixXd& M, const Eigen::MatrixXcd& B,
                               const Eigen::MatrixXcd& C) {
  if (M.rows() == 0) return {};
  const Cholesky root(M);
  if (!root.positive()) throw RotorNotSolvable(kNotFound);
  const Eigen::MatrixXcd inverse = root.lower_inverse().cast<Complex>();
  const Eigen::MatrixXcd b = inverse * B * inverse.transpose(),
                         c = inverse * C * inverse.transpose();
  return found_by(complex_eigenvalues(first_order_form(b, c, frequency_scale(c))), kNotFound);
}

}  // namespace

double slip_damping(const RubSystem& s, const SteadyRub& rub) {
  return rub.rolls() ? 0.0 : rub.normal_force * s.friction.slope(rub.slip);
}

Perturbation perturbation(const RubSystem& s, const SteadyRub& rub) {
  const Joint j = joint(s, rub.whirl);
  const Eigen::Index n = j.mass.size();
  Perturbation p{
      Eigen::MatrixXd::Zero(2 * n, 2 * n), real_form(j.rates), real_form(j.springs), {}, {}};
  p.mass.diagonal() << j.mass, j.mass;
  if (rub.rolls()) {  // c^T a = b, and the force may point anywhere
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
  // The force turns with the contact direction: eps = Im(c^T a - b) / delta_0.
  p.springs.rightCols(n) += (rub.normal_force / s.clearance) *
                            real_form(Eigen::VectorXcd(kI * push)) * j.normal.transpose();
  p.rates.bottomRightCorner(n, n) += slip_damping(s, rub) * j.normal * j.normal.transpose();
  return p;
}

std::vector<Complex> eigenvalues(const Perturbation& p) {
  // Coordinates of unit mass, y = root^-T u.
  const Cholesky root(p.mass);
  if (!root.positive()) throw RotorNotSolvable(kNotFound);
  const Eigen::MatrixXd scale = root.lower_inverse();
  const Eigen::MatrixXd K = scale * p.springs * scale.transpose();
  const Eigen::MatrixXd B = scale * p.rates * scale.transpose();
  const Eigen::MatrixXd F = scale * p.push, C = p.constraint * scale.transpose();

  // On the constraint: u = Z w, and l = -(C F)^-1 C (K u + B u').
  const Eigen::MatrixXd Z = orthogonal_complement(C.transpose());
  const Eigen::MatrixXd met = C * F;
  // With a free spin, unbalance lets friction accelerate the contact along its normal: beyond some
  // friction the contact force would have to pull (Painleve).
  if (!(lu_determinant(met) > 0.0)) throw RotorNotSolvable(kNotFound);
  const Eigen::MatrixXd along = Z.transpose() - (Z.transpose() * F) * lu_inverse(met) * C;
  const Eigen::MatrixXd rates = along * B * Z, springs = along * K * Z;
  return found_by(real_eigenvalues(first_order_form(rates, springs, frequency_scale(springs))),
                  kNotFound);
}

void leave_out_smallest(std::vector<Complex>& values, int count) {
  const auto smaller = [](const Complex& a, const Complex& b) { return std::abs(a) < std::abs(b); };
  for (int k = 0; k < count && !values.empty(); ++k) {
    values.erase(std::min_element(values.begin(), values.end(), smaller));
  }
}

std::vector<Complex> free_eigenvalues(const RubSystem& s) {
  return quadratic(s.mass.asDiagonal(), rotor_rates(s), rotor_springs(s));
}

std::vector<Complex> ring_eigenvalues(const RubSystem& s) {
  if (!s.ring) return {};
  const auto one = [](Complex x) { return Eigen::MatrixXcd::Constant(1, 1, x); };
  return quadratic(Eigen::MatrixXd::Constant(1, 1, s.ring->mass), one(s.ring->rate()),
                   one(s.ring->stiffness));
}

std::vector<Complex> joined_eigenvalues(const RubSystem& s) {
  const Eigen::VectorXd& c = s.contact;
  const Eigen::MatrixXd M = s.mass.asDiagonal();
  if (s.ring) {  // b = c^T a
    const Eigen::MatrixXd cc = c * c.transpose();
    return quadratic(M + s.ring->mass * cc, rotor_rates(s) + s.ring->rate() * cc.cast<Complex>(),
                     rotor_springs(s) + s.ring->stiffness * cc.cast<Complex>());
  }
  if (c.isZero(0.0)) return free_eigenvalues(s);
  const Eigen::MatrixXd Z = orthogonal_complement(c);  // c^T a = 0
  const Eigen::MatrixXcd z = Z.cast<Complex>();
  return quadratic(Z.transpose() * M * Z, z.transpose() * rotor_rates(s) * z,
                   z.transpose() * rotor_springs(s) * z);
}

std::vector<Complex> rub_eigenvalues(const RubSystem& s, const SteadyRub& rub) {
  if (rub.kind == RubKind::kRolling) {
    std::vector<Complex> values = joined_eigenvalues(s);
    for (Complex& value : values) value -= kI * rub.whirl;
    return values;
  }
  std::vector<Complex> values = eigenvalues(perturbation(s, rub));
  if (rub.kind == RubKind::kWhip) leave_out_smallest(values, 1);
  return values;
}

Stability stability_of(const std::vector<Complex>& eigenvalues) {
  constexpr double kRoundOff = 1e-10;
  if (eigenvalues.empty()) return {-std::numeric_limits<double>::infinity(), 0.0, true};
  Complex first = eigenvalues.front();
  for (const Complex& s : eigenvalues) {
    if (s.real() > first.real()) first = s;
  }
  return {first.real(), std::abs(first.imag()),
          first.real() <= kRoundOff * largest_size(eigenvalues)};
}

}  // namespace rotorub::rub
