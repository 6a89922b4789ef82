// Eigenvalues of a real matrix. Eigen's solver takes long to compile: it is compiled here alone.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "native_model/numerics/complex_eigenvalues.h"

namespace rotorub {

// A: n x n, any; n = 0 gives an empty list. By falling real part, of a pair the one with Im < 0
// first. Nothing where the iteration does not converge.
std::optional<std::vector<std::complex<double>>> real_eigenvalues(const Eigen::MatrixXd& A);

// As complex_modes; of a pair the value with Im > 0 comes first.
std::optional<EigenModes> real_modes(const Eigen::MatrixXd& A);

}  // namespace rotorub
