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

// A v_j = s_j v_j, |v_j| = 1.
struct RealModes {
  Eigen::VectorXcd values;   // n, in no order but that of a pair the one with Im > 0 comes first
  Eigen::MatrixXcd vectors;  // n x n, a column each
};

// A: n x n, n > 0. Nothing where the iteration does not converge.
std::optional<RealModes> real_modes(const Eigen::MatrixXd& A);

}  // namespace rotorub
