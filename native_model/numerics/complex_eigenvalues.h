// Eigenvalues of a complex matrix. Eigen's solver takes long to compile: it is compiled here alone.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

namespace rotorub {

// A: n x n, any; n = 0 gives an empty list. In no order. Nothing where the iteration does not
// converge.
std::optional<std::vector<std::complex<double>>> complex_eigenvalues(const Eigen::MatrixXcd& A);

// A v_j = s_j v_j, |v_j| = 1.
struct EigenModes {
  Eigen::VectorXcd values;   // n, in no order
  Eigen::MatrixXcd vectors;  // n x n, a column each
};
// A: n x n, n > 0. Nothing where the iteration does not converge.
std::optional<EigenModes> complex_modes(const Eigen::MatrixXcd& A);

}  // namespace rotorub
