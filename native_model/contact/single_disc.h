// One contact of disc_law.h, solved by cases. With L_N given or y_N = 0, L_N and y_T are affine in
// L_T,
//   L_N = alpha + beta . L_T,   y_T = c + S L_T.
// L_T is either the point without slip (S L_T = -c), or on the rim of the disc, or on the chord
// side . L_T = floor, or in a corner of the two. On the rim L_T = -mu L_N d, and y_T is parallel to
// d if
//   d x (c + K d) = 0,   K = mu (c beta^T - alpha S).
#pragma once

#include <Eigen/Core>

namespace rotorub {

struct DiscSet {
  double friction = 0.0;           // mu >= 0
  double least_normal = 0.0;       // n, N s
  Eigen::Vector2d side{0.0, 0.0};  // unit vector; 0: no side
  double floor = 0.0;              // with a side: N s, 0 <= floor <= mu n
};

enum class DiscFriction { kStick, kRim, kChord, kCorner };
struct DiscCase {
  bool at_bound = true;  // L_N = n, otherwise y_N = 0
  DiscFriction friction = DiscFriction::kRim;
  Eigen::Vector2d direction{1.0, 0.0};  // d, for sliding on the rim
};

struct SingleDisc {
  int solutions = 0;  // number of distinct motions; above 1: this is the first
  DiscCase found;
  Eigen::Vector3d p{0.0, 0.0, 0.0}, y{0.0, 0.0, 0.0};
};

// kFirst: stops at the first solution. kAll: also counts the others.
enum class Solutions { kFirst, kAll };

// a: symmetric, positive semidefinite. A tangential direction without motion gets a tiny mobility.
SingleDisc solve_disc(const Eigen::Matrix3d& a, const Eigen::Vector3d& b, const DiscSet& set,
                      Solutions wanted = Solutions::kAll);

}  // namespace rotorub
