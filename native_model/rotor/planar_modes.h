// Undamped planar eigenmodes at rest: K phi = omega^2 M phi.
#pragma once

#include <Eigen/Core>

namespace rotorub {

struct PlanarModes {
  Eigen::VectorXd frequency;  // rad/s, N, ascending, > 0
  Eigen::MatrixXd shape;      // N x N, columns phi with phi^T M phi = 1
};

// M, K symmetric and positive definite, N x N. The low frequencies are the accurate ones: the
// problem solved is M phi = omega^-2 K phi, in which very stiff parts are very small numbers.
// Throws RotorNotSolvable (refusal.h) where a matrix is not positive definite to working precision.
PlanarModes planar_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

}  // namespace rotorub
