// The circle of radius `clearance` (m) about the ring's centre, which the rotor's centre does not
// leave: where straight paths meet it. d: m, ring's to rotor's centre, where a path begins; path:
// m, from there.
#pragma once

#include <Eigen/Core>

namespace rotorub {

// Share of the path at which it leaves the circle: 0 where it is outside already and leads further
// out; where it is outside and leads in, the place where it comes out again. Above 1 where it does
// not leave, or never comes inside.
double circle_exit(const Eigen::Vector2d& d, const Eigen::Vector2d& path, double clearance);

// From a point p outside: the least N > 0 with p + N g on the circle; negative where g does not
// lead there.
double reach_circle(const Eigen::Vector2d& p, const Eigen::Vector2d& g, double clearance);

// Outward normal of the contact that a path which ends outside closes: that of d where the path
// leads out along it, or d is no longer inside; on a path so long that it does not, the normal
// where it leaves the circle.
Eigen::Vector2d normal_of_path(const Eigen::Vector2d& d, const Eigen::Vector2d& path,
                               double clearance);

}  // namespace rotorub
