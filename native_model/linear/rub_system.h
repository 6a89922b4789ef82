// A rotor and its ring for analysis in a rotating frame. Both planes are alike, so that one complex
// equation in r = x + i y describes them, and the spin speed Omega is held. There are n modes; c
// holds their values at the contact.
//
//   M r'' + (D + N - i Omega G) r' + (K - i Omega N) r = f(t) - c lambda (1 + i tau) e^{i psi}
//   M_f z'' + (D_f + i k) z' + K_f z = lambda (1 + i tau) e^{i psi}         (a fixed ring: z = 0)
//   c^T r - z = delta_0 e^{i psi} in contact
//   tau = mu(|slip|) sign(slip),   slip = r Omega + delta_0 psi' - R Omega_f
// D: external damping, including the bearings; N: rotating damping; K includes the negative
// stiffness of a magnetic bearing. f: rotating loads, each at one frequency. A ring that turns
// obeys J Omega_f' = R tau lambda - drag Omega_f.
//
// The model leaves out changes of the spin speed and torsion (driven_rub.h has both), on and off
// times of forces (each acts for ever) and the actuator's limits. The spring and damper of a
// passive controller are added to the ring, and so is cross-coupled feedback (for `two_phase`, the
// feedback after the hand-over), without sampling and sensors.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub::rub {

using Complex = std::complex<double>;
inline constexpr Complex kI{0.0, 1.0};

struct Ring {
  double mass, damping, stiffness;  // kg > 0, N s/m >= 0, N/m >= 0
  // N s/m, either sign: k sign(Omega) of cross-coupled feedback, which adds the force -i k z'.
  double coupling = 0.0;
  // kg m^2 > 0 and N m s >= 0, for a ring that turns: its surface moves at R Omega_f, with
  // R = r + delta_0.
  double inertia = 0.0, drag = 0.0;
  Complex rate() const { return {damping, coupling}; }  // coefficient of z'
};

// Force load e^{i frequency t} on the modes.
struct RotatingLoad {
  double frequency;       // rad/s, negative if backward
  Eigen::VectorXcd load;  // N, n
};

struct RubSystem {
  double speed = 0.0;                 // rad/s, Omega, either sign
  Eigen::VectorXd mass;               // kg, n
  Eigen::MatrixXd stiffness;          // N/m, n x n
  Eigen::MatrixXd damping, internal;  // N s/m, n x n, external and rotating damping
  Eigen::MatrixXd gyroscopic;         // kg, n x n
  Eigen::VectorXd contact;   // c, mode values at the contact; 1 or 0 if the modes are scaled
  std::optional<Ring> ring;  // empty: fixed to the base
  double clearance = 0.0, radius = 0.0;  // m, delta_0 and r
  FrictionLaw friction{};
  std::vector<RotatingLoad> forces;  // as the scene states them
  Eigen::VectorXcd unbalance;        // kg m, n: the load at frequency Omega is unbalance Omega^2
  Eigen::Index modes() const { return mass.size(); }
  bool ring_turns() const { return ring && ring->inertia > 0.0; }
  double ring_radius() const { return radius + clearance; }  // m, R
};

// The model with the rotor at rest and its rings centred. It keeps only the initial spin angle,
// from which the phases of the loads are measured. Throws scene::SceneError as make_model does.
Model model_without_start(const scene::Scene& scene);

// Throws scene::SceneError as make_model does, and if no steady whirl is possible or the equations
// above do not hold: no contact or several, compliant contact, planes that differ, constant loads,
// another kind of controller, magnets in the actuator, or a ring that turns together with friction
// that depends on the slip.
RubSystem rub_system(const scene::Scene& scene);

// The system at another spin speed. Every force keeps its ratio to the spin, so that a synchronous
// force stays synchronous; if the spin speed was 0, forces keep their frequency.
RubSystem at_speed(RubSystem system, double speed);

// Forces and unbalance; loads of equal frequency (to 1e-9) are added up, and zero loads are left
// out.
std::vector<RotatingLoad> rotating_loads(const RubSystem& system);

// D_r(nu) = K + nu Omega G - nu^2 M + i nu D + i (nu - Omega) N, n x n, N/m; nu in rad/s, forward
// positive.
Eigen::MatrixXcd dynamic_stiffness(const RubSystem& system, double nu);
// D_r(nu)^-1 load, m: n modal amplitudes of the rotor under a load (N) that rotates at nu. Not
// finite at an undamped resonance.
Eigen::VectorXcd response(const RubSystem& system, double nu, const Eigen::VectorXcd& load);
// D_s(nu) = K_f - nu^2 M_f + i nu (D_f + i k), N/m. The system must have a ring (asserted).
Complex ring_stiffness(const RubSystem& system, double nu);
// H(nu) = c^T D_r^-1 c + 1 / D_s, m/N: compliance of the relative centre to a force that rotates at
// nu. Not finite at an undamped resonance.
Complex compliance(const RubSystem& system, double nu);

}  // namespace rotorub::rub
