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

// The same of a stiffness that may leave a rigid motion free, of frequency 0. reference: rad/s, >
// 0, about the lowest frequency there is.
PlanarModes free_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                       double reference);

// What the first k modes know of a place with the shape values u, k = 1 to N. They rise with k to
// the values of all modes, u M^-1 u^T and u K^-1 u^T.
struct ModalSums {
  Eigen::VectorXd mobility;     // 1/kg, sum over the modes of (u phi)^2: 1 / effective mass
  Eigen::VectorXd flexibility;  // m/N, sum of (u phi)^2 / omega^2
};
ModalSums modal_sums(const PlanarModes& modes, const Eigen::RowVectorXd& u);

}  // namespace rotorub
