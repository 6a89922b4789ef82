// Eigenvalues of a complex matrix. Eigen's solver takes long to compile: it is compiled here alone.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace rotorub {

// A: n x n, any; n = 0 gives an empty list. In no order. Nothing where the iteration does not converge.
std::optional<std::vector<std::complex<double>>> complex_eigenvalues(const Eigen::MatrixXcd& A);

}  // namespace rotorub
