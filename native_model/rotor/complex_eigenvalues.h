// Eigenvalues of a complex matrix. Eigen's solver takes half a minute to compile: it is compiled here alone.
#pragma once

#include <Eigen/Eigenvalues>

namespace rotorub {

// A: n x n, any. eigenvalues() in no order; info() says whether they converged; no eigenvectors.
Eigen::ComplexEigenSolver<Eigen::MatrixXcd> complex_eigenvalues(const Eigen::MatrixXcd& A);

}  // namespace rotorub
