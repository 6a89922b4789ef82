#pragma once

namespace rotorub {

// A plot shows no more than 6 or 7 significant digits, and the page stays small.
inline constexpr int kDigits = 6;

// The value to so many significant digits.
double rounded(double value, int digits);

}  // namespace rotorub
