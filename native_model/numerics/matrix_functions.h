// Exponential and logarithm of a real matrix (N. J. Higham, Functions of Matrices, 2008, chapters
// 10 and 11), by Eigen's unsupported module, which takes long to compile: it is compiled here
// alone.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace rotorub {

// A: n x n, finite. Not finite where it overflows.
Eigen::MatrixXd matrix_exp(const Eigen::MatrixXd& A);

// The principal one: |Im s| < pi for all its eigenvalues s. A: n x n without an eigenvalue on the
// negative real axis or at 0 (the caller's word). Nothing where A or the result is not finite.
std::optional<Eigen::MatrixXd> matrix_log(const Eigen::MatrixXd& A);

}  // namespace rotorub
