// Eigenvalues of symmetric matrices. Eigen's solvers take long to compile: they are compiled here
// alone. All matrices n x n, n > 0; of A and B the lower triangle is read. Nothing where the
// iteration does not converge or gives what is not finite.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace rotorub {

struct SymmetricModes {
  Eigen::VectorXd values;   // n, ascending
  Eigen::MatrixXd vectors;  // n x n, a column each: V^T V = 1, with a second matrix V^T B V = 1
};

// A v = s v.
std::optional<SymmetricModes> symmetric_modes(const Eigen::MatrixXd& A);
std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A);

// A v = s B v, B positive definite (the caller's word).
std::optional<SymmetricModes> symmetric_modes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A,
                                                     const Eigen::MatrixXd& B);

}  // namespace rotorub
