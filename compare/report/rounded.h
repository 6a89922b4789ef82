#pragma once

namespace rotorub {

// The value to so many significant digits: a plot shows no more than 6 or 7, and the page stays
// small.
double rounded(double value, int digits);

}  // namespace rotorub
