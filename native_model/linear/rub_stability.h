// Small perturbations of rotor and ring: separate, joined, and about a lasting rub.
//
// About a rub, in its frame: r = (rho + a) e^{i nu t}, z = (w + b) e^{i nu t}, e_r real. While
// contact holds, c^T a - b = i delta_0 eps (the contact direction turns by eps) and the friction
// keeps its sign. With l the change of the normal force,
//
//   M a'' + (D + N - i Omega G + 2 i nu M) a' + D_r(nu) a + c (1 + i tau) (l + i lambda eps) = 0
//   M_f b'' + (D_f + 2 i nu M_f) b' + D_s(nu) b - (1 + i tau) (l + i lambda eps) = 0
//   Re(c^T a - b) = 0
//
// If mu depends on the slip, lambda dmu/d|v| acts as a damper along the slip (a negative one if mu
// falls), and the slip changes by delta_0 eps'. This adds c i lambda mu' delta_0 eps' to the first
// row and -i lambda mu' delta_0 eps' to the second.
//
// The second derivative of the constraint eliminates l. This leaves 4 n + 2 eigenvalues (4 n - 2
// with a fixed ring). A whip has one fewer: its direction is arbitrary, and that zero is left out.
// The imaginary parts are those seen in the rotating frame. Rolling contact fixes the whole
// relative centre: rotor and ring move as one, with 2 n complex eigenvalues.
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
// (driven_rub.h). l: the change of the contact force, along e_r while sliding, along e_r and e_t
// while rolling.
struct Perturbation {
  Eigen::MatrixXd mass, rates, springs;  // M (positive definite), B, K: N x N
  Eigen::MatrixXd push;                  // F, N x m, m = 1 while sliding, 2 while rolling
  Eigen::MatrixXd constraint;            // C, m x N
};

// lambda dmu/d|v|, N s/m; 0 while rolling.
double slip_damping(const RubSystem& system, const SteadyRub& rub);

// Rotor and ring with the spin held: N = 2 (n + 1), or 2 n with a fixed ring.
Perturbation perturbation(const RubSystem& system, const SteadyRub& rub);

// Eigenvalues of the equations with l eliminated by C y'' = 0: 2 (N - m) values by falling real
// part, rad/s. Throws RotorNotSolvable (rotor/refusal.h) if the iteration does not converge.
std::vector<Complex> eigenvalues(const Perturbation& p);

// Removes the `count` values nearest to 0, which belong to arbitrary directions and angles.
void leave_out_smallest(std::vector<Complex>& values, int count);

// The next three return s of e^{s t} in rad/s, by falling real part. The systems are complex, so
// each s is one whirl, forward if Im s > 0. They throw RotorNotSolvable (rotor/refusal.h) if the
// iteration does not converge.
std::vector<Complex> free_eigenvalues(const RubSystem& system);  // rotor without contact, 2 n
std::vector<Complex> ring_eigenvalues(const RubSystem& system);  // ring alone, 2; empty if fixed
std::vector<Complex> joined_eigenvalues(
    const RubSystem& system);  // rotor centre tied to the ring's, 2 n; 2 n - 2 if fixed

// Eigenvalues in the rotating frame; for rolling, those of the joined system seen in that frame.
std::vector<Complex> rub_eigenvalues(const RubSystem& system, const SteadyRub& rub);

// The least stable pair of eigenvalues.
struct Stability {
  double growth = 0.0;     // 1/s, largest real part; -infinity if nothing can move
  double frequency = 0.0;  // rad/s, of that pair, >= 0
  bool stable = true;      // growth < 0, or 0 to round-off (1e-10 of the largest eigenvalue)
};
Stability stability_of(const std::vector<Complex>& eigenvalues);

}  // namespace rotorub::rub
