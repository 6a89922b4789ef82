// Contact of a disc in a ring, (5)-(8) of the paper with d from the ring's to the rotor's centre:
//   delta = |d|, e_r = d / delta, e_t = e_z x e_r
//   g_N = delta_0 - delta,  gdot_N = -e_r . ddot,  gdot_T = e_t . ddot + r Omega_c - R Omega_r
// R = r + delta_0 and Omega_r of a ring that turns. `spin` below is Omega_c - (R/r) Omega_r.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "native_model/contact/planar_contact.h"

namespace rotorub {

struct ContactPoint {
  Eigen::Vector2d d{0.0, 0.0};    // m
  Eigen::Vector2d dv{0.0, 0.0};   // m/s, ddot
  double spin = 0.0;              // rad/s, see above; Omega_c with torsion
  double delta = 0.0;             // m
  Eigen::Vector2d e_r{1.0, 0.0};  // outward normal; (1, 0) where delta is 0 and there is none
  double gap = 0.0;               // m, g_N
  double gap_rate = 0.0;          // m/s, gdot_N; 0 where delta is 0
  double slip = 0.0;              // m/s, gdot_T; r spin where delta is 0
  bool has_normal = false;
  Eigen::Vector2d e_t() const { return {-e_r.y(), e_r.x()}; }
  // Speed of the relative centre along e_t, m/s.
  double whirl_speed() const { return e_t().dot(dv); }
};

// Under this distance (m) the centres coincide and there is no normal.
inline constexpr double kNoNormal = 1e-15;

inline ContactPoint contact_kinematics(const Eigen::Vector2d& d, const Eigen::Vector2d& dv,
                                       double spin, double radius, double clearance) {
  ContactPoint p;
  p.d = d;
  p.dv = dv;
  p.spin = spin;
  p.delta = std::sqrt(d.squaredNorm());
  p.gap = clearance - p.delta;
  p.has_normal = p.delta > kNoNormal;
  if (!p.has_normal) {
    p.slip = radius * spin;
    return p;
  }
  p.e_r = d / p.delta;
  p.gap_rate = -p.e_r.dot(dv);
  p.slip = p.whirl_speed() + radius * spin;
  return p;
}

// (gdot_N, gdot_T), m/s, of (ddot, contact spin) along the normal e_r of a touch, which the
// impulses have.
inline Eigen::Vector2d rates_along(const Eigen::Vector2d& e_r, double radius,
                                   const Eigen::Vector3d& velocity) {
  const Eigen::Vector2d e_t{-e_r.y(), e_r.x()};
  return {-e_r.dot(velocity.head<2>()), e_t.dot(velocity.head<2>()) + radius * velocity.z()};
}

// The 2x2 Delassus matrix of (N, T) for the normal e_r from the contact-space admittance A
// (relative x, relative y, spin): W_N = (-e_r, 0), W_T = (e_t, r).
Delassus delassus(const Eigen::Matrix3d& admittance, const Eigen::Vector2d& e_r, double radius);

// Load on the rotor (x, y, torque) of normal and friction impulse or force (N, T).
Eigen::Vector3d contact_load(const Eigen::Vector2d& e_r, double radius, double normal,
                             double friction);

// The circle of radius `clearance` (m) about the ring's centre, which the rotor's centre does not
// leave: where straight paths meet it. d: m, ring's to rotor's centre, where a path begins; path:
// m, from there.

// Share of the path at which it leaves the circle: 0 where it is outside already and leads further
// out; where it is outside and leads in, the place where it comes out again. Above 1 where it does
// not leave, or never comes inside.
double circle_exit(const Eigen::Vector2d& d, const Eigen::Vector2d& path, double clearance);

// From a point p outside: the least N > 0 with p + N g on the circle; negative where g does not
// lead there.
double reach_circle(const Eigen::Vector2d& p, const Eigen::Vector2d& g, double clearance);

// Outward normal of the contact that a path which ends outside closes: that of d where the path
// leads out along it, or d is no longer inside; on a path so long that it does not, the normal
// where it leaves the circle.
Eigen::Vector2d normal_of_path(const Eigen::Vector2d& d, const Eigen::Vector2d& path,
                               double clearance);

}  // namespace rotorub
