// Bending at a constant spin speed, with the states of the magnetic bearings' feedbacks, as a
// linear system. q: bending coordinates (linear_parts.h). z: states (FeedbackStates) of the
// feedbacks that work at t = 0.
//
//   M q'' + C q' + K q = F z + loads,   z' = Q q + R q' + S z
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "native_model/model/linear_parts.h"

namespace rotorub {

// y' = A y with (q, q', z) = unit y. The units keep the entries of A at similar magnitudes.
struct FirstOrderForm {
  Eigen::MatrixXd a;     // (4 n + s) square
  Eigen::VectorXd unit;  // 4 n + s
};

struct ClosedLoop : LinearParts {
  Eigen::MatrixXd force;                 // F, 2 n x s; all zero for a state that is not in use
  Eigen::MatrixXd of_q, of_v, of_state;  // Q, R, s x 2 n; S, s x s

  FirstOrderForm first_order() const;
};

// speed: Omega, rad/s. The spin and the coils of the rings are left out.
ClosedLoop closed_loop(const Model& model, double speed);

// 1/s, by falling real part; empty if the iteration does not converge.
std::optional<std::vector<std::complex<double>>> closed_loop_eigenvalues(const ClosedLoop& loop);

// Transfer functions at the frequency nu (rad/s) in the path from a feedback's deflection to its
// current: the filter of the derivative, and the lag of the amplifier. They are 1 if there is no
// filter or no lag.
std::complex<double> filter_of(const StationFeedback& feedback, double nu);
std::complex<double> lag_of(const StationFeedback& feedback, double nu);
// A/m, P + i nu D filter_of(): minus the requested current per deflection, without the integrator.
std::complex<double> gain_of(const StationFeedback& feedback, double nu);

}  // namespace rotorub
