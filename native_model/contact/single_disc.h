// One contact of disc_law.h, by cases. With L_N given or from y_N = 0 both are affine in L_T,
//   L_N = alpha + beta . L_T,   y_T = c + S L_T,
// and L_T is where nothing slides (S L_T = -c), on the rim of the disc, on the chord side . L_T =
// floor, or in a corner of the two. On the rim L_T = -mu L_N d, and y_T is parallel to d where
//   d x (c + K d) = 0,   K = mu (c beta^T - alpha S).
#pragma once

#include <Eigen/Core>

namespace rotorub {

struct DiscSet {
  double friction = 0.0;           // mu >= 0
  double least_normal = 0.0;       // n, N s
  Eigen::Vector2d side{0.0, 0.0};  // of length 1; 0: none
  double floor = 0.0;              // with a side: N s, 0 <= floor <= mu n
};

enum class DiscFriction { kStick, kRim, kChord, kCorner };
struct DiscCase {
  bool at_least = true;  // L_N = n; else y_N = 0
  DiscFriction friction = DiscFriction::kRim;
  Eigen::Vector2d direction{1.0, 0.0};  // d, of what slides on the rim
};

struct SingleDisc {
  int solutions = 0;  // of distinct motions; 0: none; above 1: the first
  DiscCase found;
  Eigen::Vector3d p{0.0, 0.0, 0.0}, y{0.0, 0.0, 0.0};
};

// a: symmetric, positive semidefinite. A tangential direction in which nothing moves is taken to
// move by a trace.
SingleDisc solve_disc(const Eigen::Matrix3d& a, const Eigen::Vector3d& b, const DiscSet& set);

}  // namespace rotorub
