// How right frequencies are, relative.
#pragma once

namespace rotorub::test {

inline constexpr double kBeam = 1e-7;   // what beam frequencies must be right to
inline constexpr double kTight = 1e-9;  // closed forms in few modes

}  // namespace rotorub::test
