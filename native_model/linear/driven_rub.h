// Lasting rubs with the spin free under its motor, and with torsion: what a speed that gives way
// does to them.
//
// y of rub_stability.h, then phi (free spin) and theta (k torsion modes). U: unbalance, f: loads
// locked to phi, both in the frame of the rub; T: the motor's torque, d its mode values there, c_t
// those at the contact; lambda (1 + i tau) the force of the rotor on the ring, p the change of its
// tangential part. What the rows of a in rub_stability.h gain, and the rows of phi and theta:
//
//   + i U phi'' + (nu G rho - i N rho - 2 Omega U) phi' - i (Omega^2 U + f) phi
//   J phi'' + Im U^H (a'' + 2 i Omega a' - Omega^2 a) + Omega^2 Re(U^H rho) phi
//           - T' (phi' + d.theta') + r p = 0
//   J_k theta_k'' + D_k theta_k' + K_k theta_k - d_k T' (phi' + d.theta') + c_k r p = 0
//   sliding: p = tau l
//   rolling: Im(c^T a - b) + r (phi + c_t.theta) = 0, p what that asks for, along e_t
//
// A ring that turns, by chi beside its steady turning: J_f chi'' + drag chi' - R p = 0, and -R chi
// in the constraint.
//
// So while it slides torsion has no way back to bending, and the spin has one through U, f, G and N
// alone. Rolling is one constraint of both: the whirl is locked to the spin, nu = -r Omega /
// delta_0.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "native_model/bearing/drive.h"
#include "native_model/linear/rub_stability.h"
#include "native_model/linear/rub_system.h"
#include "native_model/linear/steady_rub.h"
#include "native_model/scene/forward.h"

namespace rotorub::rub {

// What turns.
struct DriveTrain {
  std::optional<Drive> motor;  // nothing: the spin is held, torsion alone gives way
  double inertia = 0.0;        // kg m^2, J > 0 of the rigid spin; without a motor nothing
  // kg m^2, N m s, N m; k modes.
  Eigen::VectorXd torsion_inertia, torsion_damping, torsion_stiffness;
  Eigen::VectorXd at_contact, at_motor;  // their values there, k
  Eigen::VectorXcd locked;               // N, n: f at phi = 0
  bool fixed = false;                    // there are loads that turn at a frequency of their own
  Eigen::Index modes() const { return torsion_inertia.size(); }
};

// Of the scene of a rub_system. Throws scene::SceneError as that does, and for a motor whose torque
// does not depend on its speed alone (speed_controlled).
DriveTrain drive_train(const scene::Scene& scene);

// Of a rub that stands at the system's speed, whatever torque of the motor holds it there: its
// slope alone counts. By falling real part, rad/s; zeros that only say that a direction or the
// angle of the spin may be any are left out. A forced rub's load turns with the spin (nu = Omega)
// or there is no unbalance (asserted). Throws RotorNotSolvable (rotor/refusal.h).
std::vector<Complex> driven_eigenvalues(const RubSystem& system, const DriveTrain& train,
                                        const SteadyRub& rub);

// N m, of the motor at the system's speed: r tau lambda, of a forced rub also what the unbalance
// takes.
double torque_taken(const RubSystem& system, const SteadyRub& rub);

// Backward rolling at a speed that the motor keeps, T(Omega) = r tau lambda(Omega): to the motor
// the rub is a load with a peak at each backward resonance of rotor and ring joined, and the spin
// hangs before one of them.
struct DrivenRolling {
  double speed = 0.0;  // rad/s, Omega
  SteadyRub rub;
  double torque = 0.0;  // N m
  Stability stability;  // with the spin free
};

// 0 < |Omega| <= |top|, rad/s, of the sense of top, by rising size; none without a motor, nor on a
// ring that turns, which rolls at any whirl. Throws RotorNotSolvable.
std::vector<DrivenRolling> driven_rolling(const RubSystem& system, const DriveTrain& train,
                                          double top);

}  // namespace rotorub::rub
