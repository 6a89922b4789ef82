// A coil behind its amplifier. The current i follows the one that is asked for within the lag,
//
//   lag di/dt = a - i,   |di/dt| <= rate_limit,   |L di/dt + R i| <= voltage_limit.
#pragma once

#include "native_model/numerics/lanes.h"

namespace rotorub {

template <class T>
struct Coil {
  T lag{};                                        // s, > 0
  T rate_limit{};                                 // A/s, > 0, infinity: none
  T voltage_limit{}, inductance{}, resistance{};  // V, > 0, infinity: none; H, > 0; Ohm, >= 0

  // A: `asked`, brought so near to the present current that its rate, load - current over the lag,
  // keeps within the limit and needs no more than the voltage.
  ROTORUB_INLINE T load(const T& asked, const T& current) const {
    // di/dt of the whole voltage: (+-U - R i) / L.
    const T drop = resistance * current;
    const T falls = (-voltage_limit - drop) / inductance,
            rises = (voltage_limit - drop) / inductance;
    const T fall = lanes::larger(-rate_limit, falls);
    const T rise = lanes::select(rate_limit < rises, rate_limit, rises);
    const T least = current + lag * fall, most = current + lag * rise;
    const T raised = lanes::select(asked < least, least, asked);
    return lanes::select(raised > most, most, raised);
  }
};

}  // namespace rotorub
