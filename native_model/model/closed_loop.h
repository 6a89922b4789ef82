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

#include "native_model/model/linear_parts.h"

namespace rotorub {

// y' = A y, (q, q', z) = unit y: units in which no entry of A is far from the others.
struct FirstOrderForm {
  Eigen::MatrixXd a;     // (4 n + s) square
  Eigen::VectorXd unit;  // 4 n + s
};

struct ClosedLoop : LinearParts {
  Eigen::MatrixXd force;  // F, 2 n x s; a state that is not there has zeros everywhere
  Eigen::MatrixXd of_q, of_v, of_state;  // Q, R, s x 2 n; S, s x s

  FirstOrderForm first_order() const;
};

// speed: Omega, rad/s. States that the spin's coupling or a coil of a ring has are not among them.
ClosedLoop closed_loop(const Model& model, double speed);

// By falling real part, 1/s; nothing: the iteration does not converge.
std::optional<std::vector<std::complex<double>>> closed_loop_eigenvalues(const ClosedLoop& loop);

// Of one frequency nu (rad/s) between a feedback's deflection and its current: the derivative's
// filter and the amplifier's lag, 1 where there is none.
std::complex<double> filter_of(const StationFeedback& feedback, double nu);
std::complex<double> lag_of(const StationFeedback& feedback, double nu);
// A/m, P + i nu D with the filter: of what its own law asks for, but for what the integrator holds.
std::complex<double> gain_of(const StationFeedback& feedback, double nu);

}  // namespace rotorub
