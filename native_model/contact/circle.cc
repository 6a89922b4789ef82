#include "native_model/contact/circle.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/kinematics.h"

namespace rotorub {

double circle_exit(const Eigen::Vector2d& d, const Eigen::Vector2d& path, double clearance) {
  const double a = path.squaredNorm(), b = d.dot(path);
  const double c = d.squaredNorm() - clearance * clearance;
  if (c >= 0.0 && b > 0.0) return 0.0;
  const double square = b * b - a * c;
  if (a == 0.0 || square < 0.0) return 2.0;
  const double root = std::sqrt(square);
  // The greater root, without cancellation.
  return b > 0.0 ? -c / (b + root) : (root - b) / a;
}

double reach_circle(const Eigen::Vector2d& p, const Eigen::Vector2d& g, double clearance) {
  const double a = g.squaredNorm(), b = p.dot(g), c = p.squaredNorm() - clearance * clearance;
  const double square = b * b - a * c;
  return b < 0.0 && square > 0.0 ? c / (std::sqrt(square) - b) : -1.0;
}

Eigen::Vector2d normal_of_path(const Eigen::Vector2d& d, const Eigen::Vector2d& path,
                               double clearance) {
  const double delta = d.norm();
  if ((delta > kNoNormal && d.dot(path) > 0.0) || delta >= clearance) return d / delta;
  return (d + std::min(1.0, circle_exit(d, path, clearance)) * path).normalized();
}

}  // namespace rotorub
