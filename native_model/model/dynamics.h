// The right-hand side of (9) without contact, and the kinematics of the contact, as functions of
// (model, t, q, v). Nothing here allocates.
#pragma once

#include <Eigen/Core>
#include <span>

#include "native_model/contact/kinematics.h"
#include "native_model/model/model.h"

namespace rotorub {

namespace equations {
struct DiscAngles;  // equations.h
}

double spin_angle(const Model& model, double t, const double* q);  // rad, phi, without torsion
double spin_speed(const Model& model, const double* v);            // rad/s, Omega, without torsion

// N m, torque of the drive on the rotor; 0 without a drive.
double motor_torque(const Model& model, double t, const double* q, const double* v);

// A, current of a magnetic bearing on each axis. While its feedback does not work, only the
// decaying current of an amplifier remains; without an amplifier it is 0.
Eigen::Vector2d bearing_current(const Model& model, const StationFeedback& bearing, double t,
                                const double* q, const double* v);

// f(t, q, v), nq values in N or N m: all loads except the forces of contacts and actuators.
void unactuated_force(const Model& model, double t, const double* q, const double* v, double* f);
// Does the same for callers that know the directions of the eccentric discs.
void unactuated_force(const Model& model, double t, const equations::DiscAngles& angles,
                      const double* q, const double* v, double* f);

// The part of f that a diagonal spring-damper chain does not have: f + stiffness q + damping v. The
// plugin adds it to MuJoCo's joints.
void coupling_force(const Model& model, double t, const double* q, const double* v, double* f);

// coupling_force without the gyroscopic part, for integrators that treat it implicitly.
void load_force(const Model& model, double t, const double* q, const double* v, double* f);

// a = M(phi)^-1 f, nq values; f and a may be the same array.
void solve_mass(const Model& model, double t, const double* q, const double* f, double* a);
// Does the same with another diagonal instead of the masses, such as M + h/2 D.
void solve_mass(const Model& model, const double* diagonal, double t, const double* q,
                const double* f, double* a);

// In the contact plane, m: the rotor's centre, and the ring's displacement from rest. With
// velocities in place of q: their rates, m/s. `contact`: index of the auxiliary bearing, here and
// below.
Eigen::Vector2d rotor_point(const Model& model, const double* q, std::size_t contact = 0);
Eigen::Vector2d stator_point(const Model& model, const double* q, std::size_t contact = 0);
// m: the ring's centre, and the vector from it to the rotor's centre.
Eigen::Vector2d ring_centre(const Model& model, const double* q, std::size_t contact = 0);
Eigen::Vector2d separation(const Model& model, const double* q, std::size_t contact = 0);
ContactPoint contact_point(const Model& model, const double* q, const double* v,
                           std::size_t contact = 0);

// (ddot, contact spin) for the velocities v; the contact spin is Omega_c - (R/r) Omega_r (rad/s),
// including torsion, where Omega_r is the speed of a ring that turns.
Eigen::Vector3d contact_rates(const Model& model, const double* v, std::size_t contact = 0);
// (ddot', contact_spin') for the generalised accelerations a.
Eigen::Vector3d contact_acceleration(const Model& model, const double* a, std::size_t contact = 0);

// Contact-space admittance J M^-1 J^T (1/kg, 1/kg, 1/(kg m^2) on the diagonal), 3 x 3, with
// (relative velocity x, y, contact_spin) = J qdot.
Eigen::Matrix3d contact_admittance(const Model& model, double t, const double* q,
                                   std::size_t contact = 0);
// J_i M^-1 J_j^T for two contacts, with another diagonal instead of the masses.
Eigen::Matrix3d contact_admittance(const Model& model, const double* diagonal, double t,
                                   const double* q, std::size_t i, std::size_t j);
// f += J^T p, where p is the impulse or force on the rotor (x, y) and the torque on it about z. The
// ring receives -x, -y and, if it turns, -R/r times the torque.
void add_contact_load(const Model& model, const Eigen::Vector3d& p, double* f,
                      std::size_t contact = 0);

// energy(): J, kinetic and elastic energy. external_power(): W, power of all forces except the
// contacts and the springs (diagonal and at stations), without the states of feedbacks and coils.
// ring_forces: N, of the actuators.
double energy(const Model& model, double t, const double* q, const double* v);
double external_power(const Model& model, double t, const double* q, const double* v,
                      std::span<const Eigen::Vector2d> ring_forces);
inline double external_power(const Model& model, double t, const double* q, const double* v,
                             const Eigen::Vector2d& first_ring) {
  return external_power(model, t, q, v, std::span(&first_ring, 1));
}
// J, change of the energy at (q, v) by the blades lost in (from, to]; nonzero only if the spin is
// free. The velocities do not jump when a blade is lost, but its share of the energy disappears.
// The energy balance counts this as external work.
double switching_work(const Model& model, double from, double to, const double* q, const double* v);
// f += the forces on the rings beyond the diagonals (Model::supports), and the rates of the
// bristles.
void add_ring_supports(const Model& model, const double* q, const double* v, double* f);
// Replaces the rates of the dry-friction bristles in f by the loads M ds/dt that move them, in a
// step of length h (s), from their states in `from` to the states that follow from `v`; both have
// nq values. Their motion within the step may be fast and is computed exactly; they stay within
// full slip for any h.
void step_bristles(const Model& model, const double* v, const double* from, double h, double* f);
// W, power of the terms in f that couple a ring and its housing through their spring; energy()
// contains this spring.
double coupling_power(const Model& model, const double* q, const double* v);
// W, the part of external_power beyond (f + stiffness q) . v, for callers that already have f.
double extra_power(const Model& model, const equations::DiscAngles& angles, const double* q,
                   const double* v);

}  // namespace rotorub
