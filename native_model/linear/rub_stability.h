// Small perturbations of rotor and ring: apart, joined, and about a lasting rub.
//
// About a rub, in its frame: r = (rho + a) e^{i nu t}, z = (w + b) e^{i nu t}, e_r real. Contact
// holds, c^T a - b = i delta_0 eps (the direction turns by eps); the friction keeps its sense; l is
// the change of the normal force:
//
//   M a'' + (D + N - i Omega G + 2 i nu M) a' + D_r(nu) a + c (1 + i tau) (l + i lambda eps) = 0
//   M_f b'' + (D_f + 2 i nu M_f) b' + D_s(nu) b - (1 + i tau) (l + i lambda eps) = 0
//   Re(c^T a - b) = 0
//
// Where mu depends on the slip, lambda dmu/d|v| is a damper (or drives) along the slip, which
// changes by delta_0 eps': c i lambda mu' delta_0 eps' in the first row, -i lambda mu' delta_0 eps'
// in the second.
//
// l is eliminated by the second derivative of the constraint. 4 n + 2 eigenvalues (a fixed ring: 4
// n - 2), of a whip one less: its direction is free, and that zero is left out. Their imaginary
// parts are seen from the turning frame. Rolling contact holds the whole relative centre: rotor and
// ring move as one, in 2 n complex eigenvalues.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/linear/rub_system.h"
#include "native_model/linear/steady_rub.h"

namespace rotorub::rub {

// Small motions about a rub as real equations, while contact holds:
//
//   M y'' + B y' + K y + F l = 0,  C y = 0
//
// y: the real parts of (a, b), then their imaginary parts; further coordinates may follow
// (driven_rub.h). l: the change of the contact's force, along e_r while it slides and along e_r and
// e_t while it rolls.
struct Perturbation {
  Eigen::MatrixXd mass, rates, springs;  // M (positive definite), B, K: N x N
  Eigen::MatrixXd push;                  // F, N x m, m = 1 sliding, 2 rolling
  Eigen::MatrixXd constraint;            // C, m x N
};

// N s/m, lambda dmu/d|v|; where it rolls 0.
double slip_damping(const RubSystem& system, const SteadyRub& rub);

// Of rotor and ring, the spin held: N = 2 (n + 1), of a fixed ring 2 n.
Perturbation perturbation(const RubSystem& system, const SteadyRub& rub);

// Of the equations, l eliminated by C y'' = 0: 2 (N - m) values by falling real part, rad/s. Throws
// RotorNotSolvable (rotor/refusal.h) where the iteration does not converge.
std::vector<Complex> eigenvalues(const Perturbation& p);

// The `count` values nearest to 0, of what may point anywhere.
void leave_out_smallest(std::vector<Complex>& values, int count);

// All three: rad/s as s of e^{s t}, by falling real part; of a complex system each is one whirl, Im
// s > 0 forward. Throw RotorNotSolvable (rotor/refusal.h) where the iteration does not converge.
std::vector<Complex> free_eigenvalues(const RubSystem& system);  // rotor without contact, 2 n
std::vector<Complex> ring_eigenvalues(const RubSystem& system);  // ring alone, 2; a fixed one: none
std::vector<Complex> joined_eigenvalues(
    const RubSystem& system);  // rotor centre held to the ring's, 2 n or 2 n - 2

// In the turning frame; of rolling those of the joined system, seen from there.
std::vector<Complex> rub_eigenvalues(const RubSystem& system, const SteadyRub& rub);

// The least stable pair.
struct Stability {
  double growth = 0.0;     // 1/s, largest real part; -infinity where nothing can move
  double frequency = 0.0;  // rad/s, of that pair, >= 0
  bool stable = true;      // growth < 0, or 0 to round-off (1e-10 of the largest eigenvalue)
};
Stability stability_of(const std::vector<Complex>& eigenvalues);

}  // namespace rotorub::rub
