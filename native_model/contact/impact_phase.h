// What happens in one phase of an impact that takes the time tau, (15)-(19): velocities go straight from v_0 to
//
//   v_1 = v_0 + tau a + M^-1 W p,     p = (normal, friction) impulses, a of the loads of the touch,
//
// the coordinates with v_1. Its work has three parts: of the loads between v_0 and v_0 + tau a; of the impulse
// between v_0 + tau a and v_1, which friction and Poisson's law keep from being a gain; and, since the path goes
// with v_1 and the springs are held, what the stored energy grows by along the path at v_1 (the caller's).
// tau = 0 is the classical impact.
#pragma once

#include <Eigen/Core>
#include <span>

#include "native_model/contact/kinematics.h"

namespace rotorub {

// (gdot_N, gdot_T), m/s, of (ddot, contact spin) along the normal e_r of the touch, which the impulses have.
Eigen::Vector2d rates_along(const Eigen::Vector2d& e_r, double radius, const Eigen::Vector3d& velocity);

// to = from + tau a; all of one size.
void load_phase(double tau, std::span<const double> acceleration, std::span<const double> from,
                std::span<double> to);

// Adds the loads' work, J, on the coordinates that `force` has, which may be the first of those of the velocities.
void add_load_work(double tau, std::span<const double> force, const double* from, const double* to, double& work);

// J, of an impulse between the rates before and after it.
struct ImpulseWork {
  double normal, friction;
  double total() const { return normal + friction; }
};
ImpulseWork impulse_work(double normal, double friction, const Eigen::Vector2d& before,
                         const Eigen::Vector2d& after);

// m/s^2, -gddot_N: the loads along the normal, and the turning of the normal (What_N in (17) and (18)).
double pressing(const ContactPoint& touch, const Eigen::Vector3d& acceleration);

// eps_N of an impact at the speed v (m/s) of approach beside loads that press with a (m/s^2). Poisson's law
// returns a share of what the loads compress too: v' = eps_N (v + a tau_C) - a tau_E, after the flight
// v'' = sqrt(v'^2 + 2 a tau_E v'), which above some eps_N has a fixed point: impacts without end. So where
// the loads give back more than half of what restitution takes, v'' > (1 + eps_N) v / 2, the approach's
// share alone is returned, eps_N v / (v + a tau_C): the impacts fall off with eps_N, and contact comes to rest.
double restitution_beside_loads(double restitution, double approach, double load, double compression_time,
                                double expansion_time);

}  // namespace rotorub
