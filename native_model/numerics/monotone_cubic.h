// Piecewise cubic interpolation of Fritsch and Carlson, "Monotone piecewise cubic interpolation",
// SIAM J. Numer. Anal. 17 (1980). It passes through the points of a table, is once continuously
// differentiable and does not overshoot between points. Beyond the ends the end value is held.
#pragma once

#include <vector>

namespace rotorub {

class MonotoneCubic {
 public:
  MonotoneCubic() = default;
  // x: ascending, at least two; y: as many.
  MonotoneCubic(std::vector<double> x, std::vector<double> y);

  double value(double x) const;
  double slope(double x) const;  // 0 beyond the ends

 private:
  std::vector<double> x_, y_, tangent_;
};

}  // namespace rotorub
