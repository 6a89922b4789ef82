// Factors to the units in which people read speeds, frequencies and lengths.
#pragma once

#include <numbers>

namespace rotorub {

inline constexpr double kRpm = 30.0 / std::numbers::pi;  // rpm per rad/s
inline constexpr double kMilli = 1e3;                    // mm per m, ms per s
inline constexpr double kHz = 0.5 / std::numbers::pi;    // Hz per rad/s

}  // namespace rotorub
