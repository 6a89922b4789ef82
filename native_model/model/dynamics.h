// The right-hand side of (9) without contact and the contact's kinematics, as functions of
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
// rad/s, Omega_c - (R/r) Omega_r, with torsion; Omega_r of a ring that turns. `contact`: the number
// of the auxiliary bearing, here and below.
double contact_spin(const Model& model, const double* v, std::size_t contact = 0);

// N m, of the drive on the rotor; 0 without one.
double motor_torque(const Model& model, double t, const double* q, const double* v);

// A, of a magnetic bearing with a feedback on each axis; 0 without one, and once it has failed.
Eigen::Vector2d bearing_current(const Model& model, const StationFeedback& bearing, double t,
                                const double* q, const double* v);

// f(t, q, v), nq values: all loads but the contact's and the actuator's.
void unactuated_force(const Model& model, double t, const double* q, const double* v, double* f);
// The same for callers who know where the eccentric discs point.
void unactuated_force(const Model& model, double t, const equations::DiscAngles& angles,
                      const double* q, const double* v, double* f);

// The part of f that a diagonal spring-damper chain does not have by itself: f without
// -stiffness q - damping v. What the plugin adds to MuJoCo's joints.
void coupling_force(const Model& model, double t, const double* q, const double* v, double* f);

// coupling_force without the gyroscopic part, for integrators that treat that implicitly.
void load_force(const Model& model, double t, const double* q, const double* v, double* f);

// a = M(phi)^-1 f, nq values; may be in place.
void solve_mass(const Model& model, double t, const double* q, const double* f, double* a);
// The same with another diagonal in the place of the masses, e.g. M + h/2 D.
void solve_mass(const Model& model, const double* diagonal, double t, const double* q,
                const double* f, double* a);

// In the contact plane, m: the rotor's centre; how far the ring is from where it is at rest; both
// of velocities too.
Eigen::Vector2d rotor_point(const Model& model, const double* q, std::size_t contact = 0);
Eigen::Vector2d stator_point(const Model& model, const double* q, std::size_t contact = 0);
// m: the ring's centre, and the rotor's from it.
Eigen::Vector2d ring_centre(const Model& model, const double* q, std::size_t contact = 0);
Eigen::Vector2d separation(const Model& model, const double* q, std::size_t contact = 0);
ContactPoint contact_point(const Model& model, const double* q, const double* v,
                           std::size_t contact = 0);

// (ddot, contact_spin) of the velocities v.
Eigen::Vector3d contact_rates(const Model& model, const double* v, std::size_t contact = 0);
// (ddot', contact_spin') of the generalized accelerations a.
Eigen::Vector3d contact_acceleration(const Model& model, const double* a, std::size_t contact = 0);

// Contact-space admittance A = J M^-1 J^T (1/kg ...) of a contact, 3 x 3, J: (relative x, relative
// y, contact_spin) = J qdot.
Eigen::Matrix3d contact_admittance(const Model& model, double t, const double* q,
                                   std::size_t contact = 0);
// Of the first with another diagonal in the place of the masses.
Eigen::Matrix3d contact_admittance(const Model& model, const double* diagonal, double t,
                                   const double* q);
// J_i M^-1 J_j^T of two contacts; i = j: as above.
Eigen::Matrix3d contact_admittance(const Model& model, const double* diagonal, double t,
                                   const double* q, std::size_t i, std::size_t j);
// f += J^T p, p: impulse or force on the rotor (x, y) and torque on it about z; the ring has -x, -y
// and where it turns -R/r of the torque.
void add_contact_load(const Model& model, const Eigen::Vector3d& p, double* f,
                      std::size_t contact = 0);

// Kinetic and elastic energy, J, and the power of all forces that are not the contact's nor the
// diagonal or station springs', W; of integrators and coils neither. ring_forces: of the actuators,
// N.
double energy(const Model& model, double t, const double* q, const double* v);
double external_power(const Model& model, double t, const double* q, const double* v,
                      std::span<const Eigen::Vector2d> ring_forces);
inline double external_power(const Model& model, double t, const double* q, const double* v,
                             const Eigen::Vector2d& first_ring) {
  return external_power(model, t, q, v, std::span(&first_ring, 1));
}
// J: what the energy gains at (q, v) by the blades lost in (from, to], where the spin is free: no
// velocity jumps, and with a blade goes its part of the energy. Work of the outside in the balance.
double switching_work(const Model& model, double from, double to, const double* q, const double* v);
// f += what carries the rings beyond the diagonals (Model::supports), and the rates of its
// bristles.
void add_ring_supports(const Model& model, const double* q, const double* v, double* f);
// In the place of their rates the loads on bristles of dry friction, M ds/dt, that lead in a step
// of h (s) from their states in `from` to those that `v` gives, both nq values: at any size of h
// they stay within full slip.
void step_bristles(const Model& model, const double* v, const double* from, double h, double* f);
// W: of f, what couples a ring and its housing by their spring: energy() has it.
double coupling_power(const Model& model, const double* q, const double* v);
// What external_power has beyond (f + stiffness q) . v, for callers that hold f already.
double extra_power(const Model& model, double t, const double* q, const double* v);
double extra_power(const Model& model, const equations::DiscAngles& angles, const double* q,
                   const double* v);

}  // namespace rotorub
