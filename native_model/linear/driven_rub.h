// Lasting rubs with torsion and with the spin free under its motor: how a spin speed that can
// change affects their stability.
//
// The coordinates are y of rub_stability.h, followed by phi (free spin) and theta (k torsion
// modes). U: unbalance; f: loads locked to phi; both in the frame of the rub. T: the motor's
// torque; d: torsion mode values at the motor; c_t: torsion mode values at the contact.
// lambda (1 + i tau) is the force of the rotor on the ring and p the change of its tangential part.
// The first line is added to the rows of a in rub_stability.h; the rows of phi and theta follow:
//
//   + i U phi'' + (nu G rho - i N rho - 2 Omega U) phi' - i (Omega^2 U + f) phi
//   J phi'' + Im U^H (a'' + 2 i Omega a' - Omega^2 a) + Omega^2 Re(U^H rho) phi
//           - T' (phi' + d.theta') + r p = 0
//   J_k theta_k'' + D_k theta_k' + K_k theta_k - d_k T' (phi' + d.theta') + c_k r p = 0
//   sliding: p = tau l
//   rolling: Im(c^T a - b) + r (phi + c_t.theta) = 0, p is the force along e_t that this needs
//
// A ring that turns adds chi, the deviation from its steady rotation, with the equation
// J_f chi'' + drag chi' - R p = 0 and the term -R chi in the constraint.
//
// So during sliding torsion does not act back on bending, and the spin acts back only through U, f,
// G and N. Rolling is one constraint on both: the whirl is locked to the spin,
// nu = -r Omega / delta_0.
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

// The rotating parts: motor, spin and torsion.
struct DriveTrain {
  std::optional<Drive> motor;  // empty: the spin is prescribed and only torsion is free
  double inertia = 0.0;        // kg m^2, J > 0 of the rigid spin; unused without a motor
  // kg m^2, N m s, N m; k modes.
  Eigen::VectorXd torsion_inertia, torsion_damping, torsion_stiffness;
  Eigen::VectorXd at_contact, at_motor;  // torsion mode values at the contact and at the motor, k
  Eigen::VectorXcd locked;               // N, n: f at phi = 0
  bool fixed = false;                    // whether some loads rotate at their own frequency
  Eigen::Index modes() const { return torsion_inertia.size(); }
};

// The scene must be one that rub_system accepts. Throws scene::SceneError as make_model does, and
// for a motor whose torque does not depend on its speed alone (speed_controlled).
DriveTrain drive_train(const scene::Scene& scene);

// Eigenvalues of small motions about a rub at the system's speed, by falling real part, rad/s. The
// motor's torque there may be any; only its slope matters. Zero eigenvalues of an indifferent
// contact direction or spin angle are left out. The load of a forced rub must turn with the spin
// (nu = Omega) unless there is no unbalance (asserted). Throws RotorNotSolvable (rotor/refusal.h).
std::vector<Complex> driven_eigenvalues(const RubSystem& system, const DriveTrain& train,
                                        const SteadyRub& rub);

// Torque that the motor must supply at the system's speed, N m: r tau lambda, and for a forced rub
// also the torque of the unbalance.
double torque_taken(const RubSystem& system, const SteadyRub& rub);

// Backward rolling at a speed that the motor sustains, T(Omega) = r tau lambda(Omega). To the motor
// the rub is a load with a peak at each backward resonance of the joined rotor and ring, and the
// spin gets stuck below one of them.
struct DrivenRolling {
  double speed = 0.0;  // rad/s, Omega
  SteadyRub rub;
  double torque = 0.0;  // N m
  Stability stability;  // with the spin free
};

// All such speeds with 0 < |Omega| <= |top| and the sign of top (rad/s), by rising |Omega|. Empty
// without a motor, and for a ring that turns, because it can roll at any whirl. Throws
// RotorNotSolvable.
std::vector<DrivenRolling> driven_rolling(const RubSystem& system, const DriveTrain& train,
                                          double top);

}  // namespace rotorub::rub
