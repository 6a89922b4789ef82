#include "native_model/numerics/symmetric_eigenvalues.h"

#include <Eigen/Eigenvalues>

namespace rotorub {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

template <class Solver>
std::optional<VectorXd> values(const Solver& solver) {
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) return {};
  return solver.eigenvalues();
}

template <class Solver>
std::optional<SymmetricModes> modes(const Solver& solver) {
  const std::optional<VectorXd> found = values(solver);
  if (!found) return {};
  return SymmetricModes{*found, solver.eigenvectors()};
}

}  // namespace

std::optional<SymmetricModes> symmetric_modes(const MatrixXd& A) {
  return modes(Eigen::SelfAdjointEigenSolver<MatrixXd>(A));
}
std::optional<VectorXd> symmetric_eigenvalues(const MatrixXd& A) {
  return values(Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly));
}

std::optional<SymmetricModes> symmetric_modes(const MatrixXd& A, const MatrixXd& B) {
  return modes(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, B));
}
std::optional<VectorXd> symmetric_eigenvalues(const MatrixXd& A, const MatrixXd& B) {
  return values(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, B, Eigen::EigenvaluesOnly));
}

}  // namespace rotorub
