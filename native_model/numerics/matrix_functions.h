// Exponential and logarithm of a real matrix (N. J. Higham, Functions of Matrices, 2008, chapters
// 10 and 11), and the Riccati equation of sampled feedback. Eigen's unsupported module compiles
// slowly, so it is compiled only in matrix_functions.cc.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace rotorub {

// A: n x n, finite. The result is not finite if it overflows.
Eigen::MatrixXd matrix_exp(const Eigen::MatrixXd& A);

// The principal logarithm: |Im s| < pi for all its eigenvalues s. A: n x n, without eigenvalues at
// 0 or on the negative real axis, which is not checked. Returns nothing if A or the result is not
// finite.
std::optional<Eigen::MatrixXd> matrix_log(const Eigen::MatrixXd& A);

// The discrete algebraic Riccati equation
//
//   P = A^T P A - A^T P B (R + B^T P B)^-1 B^T P A + Q,
//
// by structure-preserving doubling (Chu, Fan, Lin, Wang 2004), which converges quadratically and
// needs no eigenvectors. Returns the symmetric stabilising solution. Q is symmetric, positive
// semi-definite; R is symmetric, positive definite. Returns nothing if there is no solution, i.e.
// if a mode that does not decay has no cost or cannot be controlled.
std::optional<Eigen::MatrixXd> solve_riccati(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                             const Eigen::MatrixXd& q, const Eigen::MatrixXd& r);

// The corresponding feedback u = -K x: K = (R + B^T P B)^-1 B^T P A.
Eigen::MatrixXd riccati_gain(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                             const Eigen::MatrixXd& r, const Eigen::MatrixXd& p);

}  // namespace rotorub
