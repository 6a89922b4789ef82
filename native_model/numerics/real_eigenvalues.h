// Eigenvalues of a real matrix. Eigen's solver takes long to compile: it is compiled here alone.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace rotorub {

// A: n x n, any; n = 0 gives an empty list. By falling real part, of a pair the one with Im < 0 first.
// Nothing where the iteration does not converge.
std::optional<std::vector<std::complex<double>>> real_eigenvalues(const Eigen::MatrixXd& A);

}  // namespace rotorub
