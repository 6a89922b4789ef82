// Two opposed electromagnets with a bias current on one axis (Schweitzer, Maslen: Magnetic
// Bearings, 2009, chapter 4). s is the displacement (m) and i the control current (A):
//
//   F(s, i) = k_m [ ((i_0 + i)/(s_0 - s))^2 - ((i_0 - i)/(s_0 + s))^2 ]
//
// F rises with i for |i| <= i_0. At s = i = 0 its slopes are k_i = 4 k_m i_0 / s_0^2 (N/A) and k_s
// = 4 k_m i_0^2 / s_0^3 (N/m, positive: it pulls away from the centre). The stop at the cores is
// not modelled. Beyond kReach of the air gap the gap terms keep their values there.
#pragma once

#include <algorithm>

namespace rotorub {

struct OpposedMagnets {
  double force_constant = 0.0;  // N m^2/A^2, k_m > 0
  double bias_current = 0.0;    // A, i_0 > 0
  double air_gap = 0.0;         // m, s_0 > 0

  static constexpr double kReach = 0.99;

  // 1/(s_0 - s)^2 and 1/(s_0 + s)^2.
  struct Gaps {
    double pulling, opposing;
  };
  Gaps gaps(double s) const {
    const double reach = kReach * air_gap;
    const double at = std::max(std::min(s, reach), -reach);
    const double near = air_gap - at, far = air_gap + at;
    return {1.0 / (near * near), 1.0 / (far * far)};
  }
  // N, force of each magnet at s = i = 0.
  double force_at_bias() const {
    return force_constant * bias_current * bias_current / (air_gap * air_gap);
  }
  double force(double s, double i) const {
    const Gaps g = gaps(s);
    const double pull = bias_current + i, oppose = bias_current - i;
    return force_constant * (g.pulling * pull * pull - g.opposing * oppose * oppose);
  }
};

}  // namespace rotorub
