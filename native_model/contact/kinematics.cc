#include "native_model/contact/kinematics.h"

#include <cmath>

namespace rotorub {

Delassus delassus(const Eigen::Matrix3d& a, const Eigen::Vector2d& e, double r) {
  // W_N = (-e_x, -e_y, 0), W_T = (-e_y, e_x, r) in contact space.
  const double ax = a(0, 0) * e.x() + a(0, 1) * e.y();  // A e_r
  const double ay = a(1, 0) * e.x() + a(1, 1) * e.y();
  const double az = a(2, 0) * e.x() + a(2, 1) * e.y();
  const double tx = -a(0, 0) * e.y() + a(0, 1) * e.x() + a(0, 2) * r;  // A W_T
  const double ty = -a(1, 0) * e.y() + a(1, 1) * e.x() + a(1, 2) * r;
  const double tz = -a(2, 0) * e.y() + a(2, 1) * e.x() + a(2, 2) * r;
  Delassus g;
  g.nn = e.x() * ax + e.y() * ay;
  g.nt = -(e.x() * tx + e.y() * ty);
  g.tn = -(-e.y() * ax + e.x() * ay + r * az);
  g.tt = -e.y() * tx + e.x() * ty + r * tz;
  return g;
}

Eigen::Vector3d contact_load(const Eigen::Vector2d& e, double radius, double normal,
                             double friction) {
  return {-e.x() * normal - e.y() * friction, -e.y() * normal + e.x() * friction,
          radius * friction};
}

std::optional<double> circle_exit(const Eigen::Vector2d& d, const Eigen::Vector2d& path,
                                  double clearance) {
  const double a = path.squaredNorm(), b = d.dot(path);
  const double c = d.squaredNorm() - clearance * clearance;
  if (c >= 0.0 && b > 0.0) return 0.0;
  const double square = b * b - a * c;
  if (a == 0.0 || square < 0.0) return {};
  const double root = std::sqrt(square);
  // The greater root, written without cancellation.
  const double fraction = b > 0.0 ? -c / (b + root) : (root - b) / a;
  if (fraction > 1.0) return {};
  return fraction;
}

std::optional<double> reach_circle(const Eigen::Vector2d& p, const Eigen::Vector2d& g,
                                   double clearance) {
  const double a = g.squaredNorm(), b = p.dot(g), c = p.squaredNorm() - clearance * clearance;
  const double square = b * b - a * c;
  if (!(b < 0.0 && square > 0.0)) return {};
  const double normal = c / (std::sqrt(square) - b);
  if (!(normal > 0.0)) return {};
  return normal;
}

Eigen::Vector2d normal_of_path(const Eigen::Vector2d& d, const Eigen::Vector2d& path,
                               double clearance) {
  const double delta = d.norm();
  if ((delta > kNoNormal && d.dot(path) > 0.0) || delta >= clearance) return d / delta;
  return (d + circle_exit(d, path, clearance).value_or(1.0) * path).normalized();
}

}  // namespace rotorub
