// A coil with its amplifier. The current i follows the commanded current a with a lag,
//
//   lag di/dt = a - i,   |di/dt| <= rate_limit,   |L di/dt + R i| <= voltage_limit.
#pragma once

#include <algorithm>

namespace rotorub {

struct Coil {
  double lag = 0.0;            // s, 0: the current follows at once, and load() is not used
  double rate_limit = 0.0;     // A/s, > 0, infinity: none
  double voltage_limit = 0.0;  // V, > 0, infinity: none
  double inductance = 0.0;     // H, > 0
  double resistance = 0.0;     // Ohm, >= 0

  // A: the commanded current, limited so that the rate (load - current) / lag keeps within the rate
  // limit and the voltage limit.
  double load(double asked, double current) const {
    // di/dt at full voltage: (+-U - R i) / L.
    const double drop = resistance * current;
    const double falls = (-voltage_limit - drop) / inductance;
    const double rises = (voltage_limit - drop) / inductance;
    const double fall = std::max(falls, -rate_limit), rise = std::min(rises, rate_limit);
    const double least = current + lag * fall, most = current + lag * rise;
    return std::min(std::max(asked, least), most);
  }
};

}  // namespace rotorub
