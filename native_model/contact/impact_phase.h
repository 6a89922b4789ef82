// What happens in one phase of an impact that takes the time tau, (15)-(19): velocities go straight
// from v_0 to
//
//   v_1 = v_0 + tau a + M^-1 W p,     p = (normal, friction) impulses, a of the loads of the touch,
//
// the coordinates with v_1. Its work has three parts: of the loads between v_0 and v_0 + tau a; of
// the impulse between v_0 + tau a and v_1, which friction and Poisson's law keep from being a gain;
// and, since the path goes with v_1 and the springs are held, what the stored energy grows by along
// the path at v_1 (the caller's). tau = 0 is the classical impact.
#pragma once

#include <Eigen/Core>
#include <span>

#include "native_model/contact/kinematics.h"

namespace rotorub {

// (gdot_N, gdot_T), m/s, of (ddot, contact spin) along the normal e_r of the touch, which the
// impulses have.
Eigen::Vector2d rates_along(const Eigen::Vector2d& e_r, double radius,
                            const Eigen::Vector3d& velocity);

// to = from + tau a; all of one size.
void load_phase(double tau, std::span<const double> acceleration, std::span<const double> from,
                std::span<double> to);

// Adds the loads' work, J, on the coordinates that `force` has, which may be the first of those of
// the velocities.
void add_load_work(double tau, std::span<const double> force, const double* from, const double* to,
                   double& work);

// J, of an impulse between the rates before and after it.
struct ImpulseWork {
  double normal, friction;
  double total() const { return normal + friction; }
};
ImpulseWork impulse_work(double normal, double friction, const Eigen::Vector2d& before,
                         const Eigen::Vector2d& after);

}  // namespace rotorub
