// A rotor on its ring as seen from a frame that turns: both planes alike, so that one complex
// equation in r = x + i y holds them, at a spin speed Omega that is held. n modes, c: their values
// at the contact.
//
//   M r'' + (D + N - i Omega G) r' + (K - i Omega N) r = f(t) - c lambda (1 + i tau) e^{i psi}
//   M_f z'' + (D_f + i k) z' + K_f z = lambda (1 + i tau) e^{i psi}         (a fixed ring: z = 0)
//   c^T r - z = delta_0 e^{i psi} in contact
// D: external damping with the bearings', N: rotating damping, K with a magnetic bearing's negative
// stiffness; tau = mu(|slip|) sign(slip), slip = r Omega + delta_0 psi' - R Omega_f. f: loads that
// turn, each at one speed. A ring that turns: J Omega_f' = R tau lambda - drag Omega_f.
//
// What is left out: the drive's yielding and torsion (the spin is held; driven_rub.h has both),
// when a force switches on and off (each acts for ever), the actuator's limits. A passive
// controller's spring and damper belong to the ring, and so does cross-coupled feedback (of
// `two_phase` what follows the hand-over), without sampling and sensors.
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
  // N s/m, either sign: k sign(Omega) of cross-coupled feedback, the force -i k z'.
  double coupling = 0.0;
  // kg m^2 > 0 and N m s >= 0, of one that turns: its surface moves at R Omega_f, R = r + delta_0.
  double inertia = 0.0, drag = 0.0;
  Complex rate() const { return {damping, coupling}; }  // of z'
};

// Force load e^{i frequency t} on the modes.
struct RotatingLoad {
  double frequency;       // rad/s, backward negative
  Eigen::VectorXcd load;  // N, n
};

struct RubSystem {
  double speed = 0.0;                 // rad/s, Omega, either sign
  Eigen::VectorXd mass;               // kg, n
  Eigen::MatrixXd stiffness;          // N/m, n x n
  Eigen::MatrixXd damping, internal;  // N s/m, n x n, external and rotating
  Eigen::MatrixXd gyroscopic;         // kg, n x n
  Eigen::VectorXd contact;   // c, of each mode at the contact; where the modes are scaled 1 or 0
  std::optional<Ring> ring;  // nothing: fixed to the base
  double clearance = 0.0, radius = 0.0;  // m, delta_0 and r
  FrictionLaw friction{};
  std::vector<RotatingLoad> forces;  // as the scene states them
  Eigen::VectorXcd unbalance;        // kg m, n: load unbalance Omega^2 at frequency Omega
  Eigen::Index modes() const { return mass.size(); }
  bool ring_turns() const { return ring && ring->inertia > 0.0; }
  double ring_radius() const { return radius + clearance; }  // m, R
};

// In the middle of the ring, whatever start the scene gives but the spin's angle, which the loads
// turn from. Throws scene::SceneError as make_model does.
Model model_without_start(const scene::Scene& scene);

// Throws scene::SceneError as make_model does, and where no whirl can be steady or the equations
// above do not hold: no contact, planes that differ, constant loads, a controller other than these,
// magnets, a ring that turns beside friction that depends on the slip.
RubSystem rub_system(const scene::Scene& scene);

// At another spin speed: every force keeps its ratio to the spin (one in step with it, as an
// unbalance, stays so); from a rotor at rest the forces keep their frequency.
RubSystem at_speed(RubSystem system, double speed);

// Forces and unbalance, those of one frequency (to 1e-9) together; loads of 0 are left out.
std::vector<RotatingLoad> rotating_loads(const RubSystem& system);

// D_r(nu) = K + nu Omega G - nu^2 M + i nu D + i (nu - Omega) N, n x n, N/m; nu in rad/s, forward
// positive.
Eigen::MatrixXcd dynamic_stiffness(const RubSystem& system, double nu);
// D_r(nu)^-1 load, m: the rotor's modes under a load that turns at nu, N, n values. Not finite at
// an undamped resonance.
Eigen::VectorXcd response(const RubSystem& system, double nu, const Eigen::VectorXcd& load);
// D_s(nu) = K_f - nu^2 M_f + i nu (D_f + i k), N/m. Asserts a ring.
Complex ring_stiffness(const RubSystem& system, double nu);
// H(nu) = c^T D_r^-1 c + 1 / D_s, m/N: the relative centre for a force that turns at nu. Not finite
// at an undamped resonance.
Complex compliance(const RubSystem& system, double nu);

}  // namespace rotorub::rub
