// Two electromagnets that pull against each other with a bias current on one axis (Schweitzer,
// Maslen: Magnetic Bearings, 2009, chapter 4), s the displacement (m), i the control current (A):
//
//   F(s, i) = k_m [ ((i_0 + i)/(s_0 - s))^2 - ((i_0 - i)/(s_0 + s))^2 ]
//
// F rises with i for |i| <= i_0. At s = i = 0 it has the slopes k_i = 4 k_m i_0 / s_0^2 (N/A) and
// k_s = 4 k_m i_0^2 / s_0^3 (N/m: it pulls away from the middle). The stop at the cores is not
// modelled: beyond kReach of the air gap the magnets pull as they do there.
#pragma once

#include "native_model/numerics/lanes.h"

namespace rotorub {

template <class T>
struct OpposedMagnets {
  T force_constant{};  // N m^2/A^2, k_m > 0
  T bias_current{};    // A, i_0 > 0
  T air_gap{};         // m, s_0 > 0

  static constexpr double kReach = 0.99;

  // 1/(s_0 - s)^2 and 1/(s_0 + s)^2.
  struct Gaps {
    T pulling, opposing;
  };
  ROTORUB_INLINE Gaps gaps(const T& s) const {
    const T reach = lanes::all<T>(kReach) * air_gap, one = lanes::all<T>(1.0);
    const T capped = lanes::select(s > reach, reach, s);
    const T at = lanes::select(capped < -reach, -reach, capped);
    const T near = air_gap - at, far = air_gap + at;
    return {one / (near * near), one / (far * far)};
  }
  // N, of each magnet in the middle.
  ROTORUB_INLINE T force_at_bias() const {
    return force_constant * bias_current * bias_current / (air_gap * air_gap);
  }
  ROTORUB_INLINE T force(const T& s, const T& i) const {
    const Gaps g = gaps(s);
    const T pull = bias_current + i, oppose = bias_current - i;
    return force_constant * (g.pulling * pull * pull - g.opposing * oppose * oppose);
  }
};

}  // namespace rotorub
