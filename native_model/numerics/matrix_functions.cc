#include "native_model/numerics/matrix_functions.h"

#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "native_model/numerics/linear_solve.h"

namespace rotorub {

Eigen::MatrixXd matrix_exp(const Eigen::MatrixXd& A) { return A.exp(); }

std::optional<Eigen::MatrixXd> matrix_log(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return {};
  Eigen::MatrixXd log = A.log();
  if (!log.allFinite()) return {};
  return log;
}

std::optional<Eigen::MatrixXd> solve_riccati(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                             const Eigen::MatrixXd& q, const Eigen::MatrixXd& r) {
  constexpr int kMostRounds = 60;  // A^(2^60): an eigenvalue 1e-17 from the unit circle
  const Eigen::Index n = a.rows();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd ak = a, g = b * Cholesky(r).solve(Eigen::MatrixXd(b.transpose())), h = q;
  for (int round = 0; round < kMostRounds; ++round) {
    const Eigen::MatrixXd w = one + g * h;
    const Eigen::MatrixXd wa = lu_solve(w, ak);  // (1 + G H)^-1 A
    const Eigen::MatrixXd wg = lu_solve(w, g);   // (1 + G H)^-1 G
    const Eigen::MatrixXd grown_h = h + ak.transpose() * h * wa;
    const Eigen::MatrixXd grown_g = g + ak * wg * ak.transpose();
    const double change = (grown_h - h).norm();
    ak = ak * wa;
    g = 0.5 * (grown_g + grown_g.transpose());
    h = 0.5 * (grown_h + grown_h.transpose());
    if (!std::isfinite(h.norm())) return std::nullopt;
    if (change <= 1e-15 * h.norm()) return h;
  }
  return std::nullopt;
}

Eigen::MatrixXd riccati_gain(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                             const Eigen::MatrixXd& r, const Eigen::MatrixXd& p) {
  return Cholesky(r + b.transpose() * p * b).solve(Eigen::MatrixXd(b.transpose() * p * a));
}

}  // namespace rotorub
