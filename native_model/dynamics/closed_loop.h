// Bending at a held spin speed with all that magnetic bearings' feedbacks remember, as a linear
// system: coordinates q (linear_parts.h) and states z (FeedbackStates) of the feedbacks that work
// at t = 0,
//
//   M q'' + C q' + K q = F z + loads,   z' = Q q + R q' + S z
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "native_model/dynamics/linear_parts.h"

namespace rotorub {

struct ClosedLoop : LinearParts {
  Eigen::MatrixXd force;  // F, 2 n x s; a state that is not there has zeros everywhere
  Eigen::MatrixXd of_q, of_v, of_state;  // Q, R, s x 2 n; S, s x s

  // First-order form, (2 n + 2 n + s) square: y' = A y, y = (q, q', z) in units in which no entry
  // is far from the others.
  Eigen::MatrixXd first_order() const;
};

// speed: Omega, rad/s. States that the spin's coupling or a coil of a ring has are not among them.
ClosedLoop closed_loop(const Model& model, double speed);

// By falling real part, 1/s; nothing: the iteration does not converge.
std::optional<std::vector<std::complex<double>>> closed_loop_eigenvalues(const ClosedLoop& loop);

}  // namespace rotorub
