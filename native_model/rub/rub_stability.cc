#include "native_model/rub/rub_stability.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rub/perturbation.h"

namespace rotorub::rub {
namespace {

[[noreturn]] void fail() { throw RotorNotSolvable("no eigenvalues of its rub can be found"); }

// s of s^2 M + s B + C, M real and positive definite.
std::vector<Complex> quadratic(const Eigen::MatrixXd& M, const Eigen::MatrixXcd& B,
                               const Eigen::MatrixXcd& C) {
  if (M.rows() == 0) return {};
  const Eigen::LLT<Eigen::MatrixXd> root(M);
  if (root.info() != Eigen::Success) fail();
  const Eigen::MatrixXcd inverse =
      root.matrixL().solve(Eigen::MatrixXd::Identity(M.rows(), M.rows())).cast<Complex>();
  const Eigen::MatrixXcd b = inverse * B * inverse.transpose(),
                         c = inverse * C * inverse.transpose();
  const auto values = complex_eigenvalues(first_order_form(b, c, frequency_scale(c)));
  if (!values) fail();
  return *values;
}

}  // namespace

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
  const Eigen::MatrixXd Z = complement(c);  // c^T a = 0
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
  double largest = 0.0;
  Complex first = eigenvalues.front();
  for (const Complex& s : eigenvalues) {
    largest = std::max(largest, std::abs(s));
    if (s.real() > first.real()) first = s;
  }
  return {first.real(), std::abs(first.imag()), first.real() <= kRoundOff * largest};
}

}  // namespace rotorub::rub
