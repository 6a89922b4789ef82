// Small motions about a lasting rub as real equations, while contact holds:
//
//   M y'' + B y' + K y + F l = 0,  C y = 0
//
// y: the real parts of (a, b), then their imaginary parts, in the frame of rub_stability.h; further
// coordinates may follow (driven_rub.h). l: the change of the contact's force, along e_r while it
// slides and along e_r and e_t while it rolls.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/rub/rub_system.h"
#include "native_model/rub/steady_rub.h"

namespace rotorub::rub {

struct Perturbation {
  Eigen::MatrixXd mass, rates, springs;  // M (positive definite), B, K: N x N
  Eigen::MatrixXd push;                  // F, N x m, m = 1 sliding, 2 rolling
  Eigen::MatrixXd constraint;            // C, m x N
};

// Of rotor and ring, the spin held: N = 2 (n + 1), of a fixed ring 2 n.
Perturbation perturbation(const RubSystem& system, const SteadyRub& rub);

// Of the equations, l eliminated by C y'' = 0: 2 (N - m) values by falling real part, rad/s. Throws
// RotorNotSolvable (rotor/refusal.h) where the iteration does not converge.
std::vector<Complex> eigenvalues(const Perturbation& p);

// The `count` values nearest to 0, of what may point anywhere.
void leave_out_smallest(std::vector<Complex>& values, int count);

// The inertial frame's D + N - i Omega G, N s/m, and K - i Omega N, N/m, n x n.
Eigen::MatrixXcd rotor_rates(const RubSystem& system);
Eigen::MatrixXcd rotor_springs(const RubSystem& system);

// Orthonormal, n x (n - m): what is normal to the m independent columns of `directions`, n x m.
Eigen::MatrixXd complement(const Eigen::MatrixXd& directions);

}  // namespace rotorub::rub
