// Kinematics of a disc in a ring, with d from the ring's centre to the rotor's centre:
//   delta = |d|, e_r = d / delta, e_t = e_z x e_r
//   g_N = delta_0 - delta,  gdot_N = -e_r . ddot,  gdot_T = e_t . ddot + r Omega_c - R Omega_r
// These are (5)-(8) of Chavez and Ulbrich; all comments cite the equations of that paper by its
// numbers (native_model/docs/theory.md). A dot stands for one derivative with respect to time: ddot
// is d'. Here R = r + delta_0, and Omega_r is the speed of a ring that turns. `spin` below is
// Omega_c - (R/r) Omega_r.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "native_model/contact/planar_contact.h"

namespace rotorub {

struct ContactPoint {
  Eigen::Vector2d d{0.0, 0.0};    // m
  Eigen::Vector2d dv{0.0, 0.0};   // m/s, ddot
  double spin = 0.0;              // rad/s, see above; Omega_c includes torsion
  double delta = 0.0;             // m
  Eigen::Vector2d e_r{1.0, 0.0};  // outward normal; (1, 0) if there is none
  double gap = 0.0;               // m, g_N
  double gap_rate = 0.0;          // m/s, gdot_N; 0 without a normal
  double slip = 0.0;              // m/s, gdot_T; r spin without a normal
  bool has_normal = false;
  Eigen::Vector2d e_t() const { return {-e_r.y(), e_r.x()}; }
  // m/s, speed of the relative centre along e_t.
  double whirl_speed() const { return e_t().dot(dv); }
};

// m; at smaller distances the centres count as coincident, so there is no normal.
inline constexpr double kNoNormal = 1e-15;

inline ContactPoint contact_kinematics(const Eigen::Vector2d& d, const Eigen::Vector2d& dv,
                                       double spin, double radius, double clearance) {
  // Plain numbers, because reading two of them back as one vector stalls the hot loops.
  const double x = d.x(), y = d.y(), vx = dv.x(), vy = dv.y();
  const double delta = std::sqrt(x * x + y * y);
  ContactPoint p;
  p.d = {x, y};
  p.dv = {vx, vy};
  p.spin = spin;
  p.delta = delta;
  p.gap = clearance - delta;
  p.has_normal = delta > kNoNormal;
  if (!p.has_normal) {
    p.slip = radius * spin;
    return p;
  }
  const double ex = x / delta, ey = y / delta;
  p.e_r = {ex, ey};
  p.gap_rate = -(ex * vx + ey * vy);
  p.slip = (ex * vy - ey * vx) + radius * spin;
  return p;
}

// (gdot_N, gdot_T), m/s, for a velocity (ddot, contact spin) and the normal e_r at the touch, along
// which the impulses act.
inline Eigen::Vector2d rates_along(const Eigen::Vector2d& e_r, double radius,
                                   const Eigen::Vector3d& velocity) {
  const Eigen::Vector2d e_t{-e_r.y(), e_r.x()};
  return {-e_r.dot(velocity.head<2>()), e_t.dot(velocity.head<2>()) + radius * velocity.z()};
}

// The 2x2 Delassus matrix of (N, T) for the normal e_r from the contact-space admittance A
// (relative x, relative y, spin): W_N = (-e_r, 0), W_T = (e_t, r).
Delassus delassus(const Eigen::Matrix3d& admittance, const Eigen::Vector2d& e_r, double radius);

// Load (x, y, torque) on the rotor by a normal and a friction impulse or force.
Eigen::Vector3d contact_load(const Eigen::Vector2d& e_r, double radius, double normal,
                             double friction);

// Intersections of straight paths with the circle of radius `clearance` (m) about the ring's
// centre, which the rotor's centre cannot leave. d: m, start of the path, from the ring's to the
// rotor's centre; path: m, displacement from there.

// Fraction of the path at which it leaves the circle, in [0, 1]; empty if it does not. It is 0 if
// the path starts outside and leads further out. If the path starts outside and leads inward, it is
// the point where the path comes out again.
std::optional<double> circle_exit(const Eigen::Vector2d& d, const Eigen::Vector2d& path,
                                  double clearance);

// For a point p outside: the least N > 0 for which p + N g lies on the circle; empty if there is
// none.
std::optional<double> reach_circle(const Eigen::Vector2d& p, const Eigen::Vector2d& g,
                                   double clearance);

// Outward normal of the contact that closes on a path ending outside the circle. It is the
// direction of d if the path leads outward from d, or if d is already on the circle or outside.
// Otherwise the path crosses the circle, and the normal is taken at the point where it leaves.
Eigen::Vector2d normal_of_path(const Eigen::Vector2d& d, const Eigen::Vector2d& path,
                               double clearance);

// Round-off of a contact on its circle, |d| = delta_0: a gap of this share of the clearance and a
// gap rate of kNoGapRate (m/s) count as 0.
inline constexpr double kOnCircle = 1e-12;
inline constexpr double kNoGapRate = 1e-9;

// True if the gap is closed. gap, clearance: m.
inline bool is_on_circle(double gap, double clearance) { return gap <= kOnCircle * clearance; }
// True if the gap is closed and does not change. gap_rate: m/s.
inline bool rests_on_circle(double gap, double gap_rate, double clearance) {
  return is_on_circle(gap, clearance) && std::abs(gap_rate) <= kNoGapRate;
}

}  // namespace rotorub
