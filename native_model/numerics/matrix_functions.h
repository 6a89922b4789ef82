// Exponential and logarithm of a real matrix (N. J. Higham, Functions of Matrices, 2008, chapters
// 10 and 11), by Eigen's unsupported module, which takes long to compile: it is compiled here
// alone. And the Riccati equation of sampled feedback.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace rotorub {

// A: n x n, finite. Not finite where it overflows.
Eigen::MatrixXd matrix_exp(const Eigen::MatrixXd& A);

// The principal one: |Im s| < pi for all its eigenvalues s. A: n x n without an eigenvalue on the
// negative real axis or at 0 (the caller's word). Nothing where A or the result is not finite.
std::optional<Eigen::MatrixXd> matrix_log(const Eigen::MatrixXd& A);

// The discrete algebraic Riccati equation
//
//   P = A^T P A - A^T P B (R + B^T P B)^-1 B^T P A + Q,
//
// by structure-preserving doubling (Chu, Fan, Lin, Wang 2004): quadratic, without eigenvectors.
// The stabilising solution, symmetric. Q symmetric, positive semi-definite; R symmetric, positive
// definite. Nothing where there is none (a mode that costs nothing or that u does not reach does
// not decay).
std::optional<Eigen::MatrixXd> solve_riccati(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                             const Eigen::MatrixXd& q, const Eigen::MatrixXd& r);

// The feedback u = -K x that goes with it: K = (R + B^T P B)^-1 B^T P A.
Eigen::MatrixXd riccati_gain(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                             const Eigen::MatrixXd& r, const Eigen::MatrixXd& p);

}  // namespace rotorub
