// What is known of an impact, or with a soft contact of an episode of contact.
#pragma once

#include <Eigen/Core>

namespace rotorub {

// J, of an impulse between the rates (gdot_N, gdot_T) before and after it, which friction and
// Poisson's law keep from being a gain.
struct ImpulseWork {
  double normal, friction;
  double total() const { return normal + friction; }
};
inline ImpulseWork impulse_work(double normal, double friction, const Eigen::Vector2d& before,
                                const Eigen::Vector2d& after) {
  return {0.5 * normal * (before.x() + after.x()), 0.5 * friction * (before.y() + after.y())};
}

// Impulses on the rotor: normal >= 0, tangential signed along e_t. Speeds: gap rate (negative
// closing) and slip gdot_T.
struct Impact {
  double t = 0.0;                                       // s
  double normal_impulse = 0.0, friction_impulse = 0.0;  // N s
  double gap_rate_before = 0.0, gap_rate_after = 0.0;   // m/s
  double slip_before = 0.0, slip_after = 0.0;           // m/s
  double energy_change = 0.0;                           // J, of the system, <= 0
  int contact = 0;                                      // which of several, from 0
};
inline constexpr double kCountedGapRate = -1e-4;  // m/s: an impact counts below this
inline bool counts(const Impact& impact) { return impact.gap_rate_before < kCountedGapRate; }

}  // namespace rotorub
