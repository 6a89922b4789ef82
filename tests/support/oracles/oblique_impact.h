// Oblique impact of a homogeneous sphere without spin on a plane, with Poisson's and Coulomb's laws
// and no tangential restitution (Foerster, Louge, Chang and Allia, Physics of Fluids 6, 1994). m:
// mass, r: radius, v_n, v_t: speeds before the impact, p = (1 + e) m v_n. The slip v_t - r omega
// changes by 7/2 of the friction impulse over m, so the friction impulse is
//   mu p          if v_t >= 7/2 mu (1 + e) v_n (sliding throughout)
//   2/7 m v_t     otherwise (rolling at the end)
// and omega = 5/2 friction / (m r).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotorub::oracle {

struct ObliqueImpact {
  double radius = 2.5e-3;    // m
  double density = 4000.0;   // kg/m^3
  double friction = 0.092;   // 1, mu
  double speed = 3.9;        // m/s
  double angle = 0.0;        // rad, from the normal
  double restitution = 1.0;  // 1, e

  double mass() const { return density * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }
  double inertia() const { return 0.4 * mass() * radius * radius; }
  double normal_speed() const { return speed * std::cos(angle); }
  double tangential_speed() const { return speed * std::sin(angle); }
  bool rolls() const {
    return 2.0 / 7.0 * tangential_speed() < friction * (1.0 + restitution) * normal_speed();
  }
  double friction_impulse() const {  // N s, absolute value
    return mass() * std::min(friction * (1.0 + restitution) * normal_speed(),
                             2.0 / 7.0 * tangential_speed());
  }
  double tangential_speed_after() const { return tangential_speed() - friction_impulse() / mass(); }
  double spin_after() const { return 2.5 * friction_impulse() / (mass() * radius); }  // rad/s
};

inline constexpr double kObliqueAngles[] = {20.0, 45.0, 60.0};  // degrees; only the first rolls
inline constexpr double kObliqueRestitutions[] = {0.5, 0.8, 0.9, 0.98};

}  // namespace rotorub::oracle
