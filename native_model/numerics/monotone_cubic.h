// The piecewise cubic of Fritsch and Carlson, "Monotone piecewise cubic interpolation", SIAM J.
// Numer. Anal. 17 (1980), through the points of a table: once differentiable, and no overshoot
// between two points. Beyond the ends the value there is held.
#pragma once

#include <vector>

namespace rotorub {

class MonotoneCubic {
 public:
  MonotoneCubic() = default;
  // x: ascending, two or more; y: as many.
  MonotoneCubic(std::vector<double> x, std::vector<double> y);

  double value(double x) const;
  double slope(double x) const;  // 0 beyond the ends

 private:
  std::vector<double> x_, y_, tangent_;
};

}  // namespace rotorub
