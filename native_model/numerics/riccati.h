// The discrete algebraic Riccati equation
//
//   P = A^T P A - A^T P B (R + B^T P B)^-1 B^T P A + Q,
//
// by structure-preserving doubling (Chu, Fan, Lin, Wang 2004): quadratic, without eigenvectors.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace rotorub {

// The stabilising solution, symmetric. Q symmetric, positive semi-definite; R symmetric, positive
// definite. Nothing where there is none (a mode that costs nothing or that u does not reach does
// not decay).
std::optional<Eigen::MatrixXd> solve_riccati(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                             const Eigen::MatrixXd& q, const Eigen::MatrixXd& r);

// The feedback u = -K x that goes with it: K = (R + B^T P B)^-1 B^T P A.
Eigen::MatrixXd riccati_gain(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                             const Eigen::MatrixXd& r, const Eigen::MatrixXd& p);

}  // namespace rotorub
