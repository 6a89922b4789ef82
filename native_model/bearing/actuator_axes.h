// The two axes of the actuator at 45 degrees: a_1 = (1, 1)/sqrt 2, a_2 = (-1, 1)/sqrt 2.
#pragma once

#include <Eigen/Core>

namespace rotorub {

inline constexpr double kHalfRoot = 0.70710678118654752440;  // 1/sqrt 2

// (a_1 . r, a_2 . r) of a vector in the fixed frame.
inline Eigen::Vector2d to_axes(const Eigen::Vector2d& r) {
  return {kHalfRoot * (r.x() + r.y()), kHalfRoot * (r.y() - r.x())};
}

// s_1 a_1 + s_2 a_2, in the fixed frame.
inline Eigen::Vector2d from_axes(const Eigen::Vector2d& s) {
  return {kHalfRoot * (s.x() - s.y()), kHalfRoot * (s.x() + s.y())};
}

}  // namespace rotorub
