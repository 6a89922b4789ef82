#include "native_model/numerics/complex_eigenvalues.h"

#include <Eigen/Eigenvalues>

namespace rotorub {

std::optional<std::vector<std::complex<double>>> complex_eigenvalues(const Eigen::MatrixXcd& A) {
  if (A.rows() == 0) return std::vector<std::complex<double>>();
  if (!A.allFinite()) return {};
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(A, false);
  if (solver.info() != Eigen::Success) return {};
  return std::vector<std::complex<double>>(solver.eigenvalues().begin(),
                                           solver.eigenvalues().end());
}

std::optional<EigenModes> complex_modes(const Eigen::MatrixXcd& A) {
  if (!A.allFinite()) return {};
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(A);
  if (solver.info() != Eigen::Success) return {};
  return EigenModes{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace rotorub
