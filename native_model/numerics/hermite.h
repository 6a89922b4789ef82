// Cubic interpolation between two instants.
#pragma once

namespace rotorub {

// Hermite's cubic over a length h at the fraction s in [0, 1]: values a, b and rates da, db (per
// unit of h) at its ends.
inline double hermite(double a, double da, double b, double db, double h, double s) {
  const double r = 1.0 - s;
  return r * r * ((1.0 + 2.0 * s) * a + s * h * da) + s * s * ((3.0 - 2.0 * s) * b - r * h * db);
}

}  // namespace rotorub
