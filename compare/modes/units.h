// Speeds and frequencies as people read them.
#pragma once

#include <numbers>

namespace rotorub {

inline constexpr double kRpm = 30.0 / std::numbers::pi;  // rpm in a rad/s
inline constexpr double kHz = 0.5 / std::numbers::pi;    // Hz in a rad/s

}  // namespace rotorub
