#include "native_model/contact/kinematics.h"

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

}  // namespace rotorub
