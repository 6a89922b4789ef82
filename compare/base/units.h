// Speeds, frequencies and lengths as people read them.
#pragma once

#include <numbers>

namespace rotorub {

inline constexpr double kRpm = 30.0 / std::numbers::pi;  // rpm in a rad/s
inline constexpr double kMilli = 1e3;                    // mm in a m, ms in a s
inline constexpr double kHz = 0.5 / std::numbers::pi;    // Hz in a rad/s

}  // namespace rotorub
