#include "native_model/numerics/eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace rotorub {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Values = std::vector<std::complex<double>>;

template <class Solver, class Matrix>
std::optional<Values> sorted_values(const Matrix& A) {
  if (A.rows() == 0) return Values();
  if (!A.allFinite()) return {};
  const Solver solver(A, false);
  if (solver.info() != Eigen::Success) return {};
  Values values(solver.eigenvalues().begin(), solver.eigenvalues().end());
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() < b.imag();
  });
  return values;
}

template <class Solver, class Matrix>
std::optional<EigenModes> modes_of(const Matrix& A) {
  if (!A.allFinite()) return {};
  const Solver solver(A);
  if (solver.info() != Eigen::Success) return {};
  return EigenModes{solver.eigenvalues(), solver.eigenvectors()};
}

template <class Solver>
std::optional<VectorXd> symmetric_values(const Solver& solver) {
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) return {};
  return solver.eigenvalues();
}

template <class Solver>
std::optional<SymmetricModes> modes_of_symmetric(const Solver& solver) {
  const std::optional<VectorXd> found = symmetric_values(solver);
  if (!found) return {};
  return SymmetricModes{*found, solver.eigenvectors()};
}

}  // namespace

std::optional<Values> real_eigenvalues(const MatrixXd& A) {
  return sorted_values<Eigen::EigenSolver<MatrixXd>>(A);
}
std::optional<Values> complex_eigenvalues(const MatrixXcd& A) {
  return sorted_values<Eigen::ComplexEigenSolver<MatrixXcd>>(A);
}

std::optional<EigenModes> real_modes(const MatrixXd& A) {
  return modes_of<Eigen::EigenSolver<MatrixXd>>(A);
}
std::optional<EigenModes> complex_modes(const MatrixXcd& A) {
  return modes_of<Eigen::ComplexEigenSolver<MatrixXcd>>(A);
}

std::optional<SymmetricModes> symmetric_modes(const MatrixXd& A) {
  return modes_of_symmetric(Eigen::SelfAdjointEigenSolver<MatrixXd>(A));
}
std::optional<VectorXd> symmetric_eigenvalues(const MatrixXd& A) {
  return symmetric_values(Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly));
}

std::optional<SymmetricModes> symmetric_modes(const MatrixXd& A, const MatrixXd& B) {
  return modes_of_symmetric(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, B));
}
std::optional<VectorXd> symmetric_eigenvalues(const MatrixXd& A, const MatrixXd& B) {
  return symmetric_values(
      Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, B, Eigen::EigenvaluesOnly));
}

}  // namespace rotorub
