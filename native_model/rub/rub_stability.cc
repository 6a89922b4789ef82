#include "native_model/rub/rub_stability.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/numerics/complex_eigenvalues.h"
#include "native_model/numerics/real_eigenvalues.h"
#include "native_model/rotor/refusal.h"

namespace rotorub::rub {
namespace {


[[noreturn]] void fail() { throw RotorNotSolvable("no eigenvalues of its rub can be found"); }

// Velocities and w q as state: entries of both halves are then of the size of a frequency.
double frequency_scale(double stiffness) { return stiffness > 0.0 ? std::sqrt(stiffness) : 1.0; }

// v' = -C (w q) / w - B v, (w q)' = w v
template <class Matrix>
Matrix state_matrix(const Matrix& B, const Matrix& C) {
  const Eigen::Index n = B.rows();
  const double w = frequency_scale(n > 0 ? C.cwiseAbs().maxCoeff() : 0.0);
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).diagonal().setConstant(w);
  A.bottomLeftCorner(n, n) = -C / w;
  A.bottomRightCorner(n, n) = -B;
  return A;
}

void sort_by_growth(std::vector<Complex>& values) {
  std::sort(values.begin(), values.end(), [](const Complex& a, const Complex& b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() < b.imag();
  });
}

// s of s^2 M + s B + C, M real and positive definite.
std::vector<Complex> quadratic(const Eigen::MatrixXd& M, const Eigen::MatrixXcd& B,
                               const Eigen::MatrixXcd& C) {
  if (M.rows() == 0) return {};
  const Eigen::LLT<Eigen::MatrixXd> root(M);
  if (root.info() != Eigen::Success) fail();
  const Eigen::MatrixXcd inverse =
      root.matrixL().solve(Eigen::MatrixXd::Identity(M.rows(), M.rows())).cast<Complex>();
  const Eigen::MatrixXcd b = inverse * B * inverse.transpose(), c = inverse * C * inverse.transpose();
  auto values = complex_eigenvalues(state_matrix(b, c));
  if (!values) fail();
  sort_by_growth(*values);
  return *values;
}

// Of the inertial frame: D + N - i Omega G, K - i Omega N.
Eigen::MatrixXcd rates(const RubSystem& s) {
  return (s.damping + s.internal).cast<Complex>() - (kI * s.speed) * s.gyroscopic.cast<Complex>();
}
Eigen::MatrixXcd springs(const RubSystem& s) {
  return s.stiffness.cast<Complex>() - (kI * s.speed) * s.internal.cast<Complex>();
}

// Orthonormal, n x (n - 1): what is normal to `direction`, which is not 0.
Eigen::MatrixXd complement(const Eigen::VectorXd& direction) {
  const Eigen::Index n = direction.size();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(direction);
  return qr.householderQ() * Eigen::MatrixXd::Identity(n, n).rightCols(n - 1);
}

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
  j.rates.topLeftCorner(n, n) = rates(s);
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

std::vector<Complex> slipping(const RubSystem& s, const SteadyRub& rub) {
  const Joint j = joint(s, rub.whirl);
  const Eigen::Index n = j.mass.size();
  const Eigen::VectorXcd push = Complex(1.0, rub.friction) * j.normal.cast<Complex>();
  // The force turns with the contact: eps = Im(normal^T y) / delta_0.
  Eigen::MatrixXd springs = real_form(j.springs);
  springs.rightCols(n) += (rub.normal_force / s.clearance) *
                          real_form(Eigen::VectorXcd(kI * push)) * j.normal.transpose();

  // Coordinates of unit mass.
  Eigen::VectorXd scale(2 * n);
  scale << j.mass.cwiseSqrt().cwiseInverse(), j.mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd K = scale.asDiagonal() * springs * scale.asDiagonal();
  const Eigen::MatrixXd B = scale.asDiagonal() * real_form(j.rates) * scale.asDiagonal();
  const Eigen::VectorXd F = scale.cwiseProduct(real_form(push));
  Eigen::VectorXd normal = Eigen::VectorXd::Zero(2 * n);
  normal.head(n) = scale.head(n).cwiseProduct(j.normal);

  // On the constraint: y = Z u, and l = -normal^T (K y + B y') / (normal^T F), normal^T F > 0.
  const Eigen::MatrixXd Z = complement(normal);
  const Eigen::MatrixXd along =
      Z.transpose() - (Z.transpose() * F) * (normal.transpose() / normal.dot(F));
  const auto values = real_eigenvalues(
      state_matrix(Eigen::MatrixXd(along * B * Z), Eigen::MatrixXd(along * K * Z)));
  if (!values) fail();
  return *values;
}

void leave_out_smallest(std::vector<Complex>& values) {
  values.erase(std::min_element(values.begin(), values.end(), [](const Complex& a, const Complex& b) {
    return std::abs(a) < std::abs(b);
  }));
}

}  // namespace

std::vector<Complex> free_eigenvalues(const RubSystem& s) {
  return quadratic(s.mass.asDiagonal(), rates(s), springs(s));
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
    return quadratic(M + s.ring->mass * cc, rates(s) + s.ring->rate() * cc.cast<Complex>(),
                     springs(s) + s.ring->stiffness * cc.cast<Complex>());
  }
  if (c.isZero(0.0)) return free_eigenvalues(s);
  const Eigen::MatrixXd Z = complement(c);  // c^T a = 0
  const Eigen::MatrixXcd z = Z.cast<Complex>();
  return quadratic(Z.transpose() * M * Z, z.transpose() * rates(s) * z,
                   z.transpose() * springs(s) * z);
}

std::vector<Complex> rub_eigenvalues(const RubSystem& s, const SteadyRub& rub) {
  if (rub.kind == RubKind::kRolling) {
    std::vector<Complex> values = joined_eigenvalues(s);
    for (Complex& value : values) value -= kI * rub.whirl;
    return values;
  }
  std::vector<Complex> values = slipping(s, rub);
  if (rub.kind == RubKind::kWhip) leave_out_smallest(values);
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
