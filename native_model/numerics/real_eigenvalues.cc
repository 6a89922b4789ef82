#include "native_model/numerics/real_eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace rotorub {
namespace {

using Solver = Eigen::EigenSolver<Eigen::MatrixXd>;

}  // namespace

std::optional<std::vector<std::complex<double>>> real_eigenvalues(const Eigen::MatrixXd& A) {
  if (A.rows() == 0) return std::vector<std::complex<double>>();
  if (!A.allFinite()) return {};
  const Solver solver(A, false);
  if (solver.info() != Eigen::Success) return {};
  std::vector<std::complex<double>> values(solver.eigenvalues().begin(),
                                           solver.eigenvalues().end());
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() < b.imag();
  });
  return values;
}

std::optional<EigenModes> real_modes(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return {};
  const Solver solver(A);
  if (solver.info() != Eigen::Success) return {};
  return EigenModes{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace rotorub
