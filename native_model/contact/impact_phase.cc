#include "native_model/contact/impact_phase.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace rotorub {

Eigen::Vector2d rates_along(const Eigen::Vector2d& e_r, double radius, const Eigen::Vector3d& velocity) {
  const Eigen::Vector2d e_t{-e_r.y(), e_r.x()};
  return {-e_r.dot(velocity.head<2>()), e_t.dot(velocity.head<2>()) + radius * velocity.z()};
}

void load_phase(double tau, std::span<const double> acceleration, std::span<const double> from,
                std::span<double> to) {
  assert(acceleration.size() == to.size() && from.size() == to.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + tau * acceleration[i];
}

void add_load_work(double tau, std::span<const double> force, const double* from, const double* to, double& work) {
  for (std::size_t i = 0; i < force.size(); ++i) work += 0.5 * tau * force[i] * (from[i] + to[i]);
}

ImpulseWork impulse_work(double normal, double friction, const Eigen::Vector2d& before,
                         const Eigen::Vector2d& after) {
  return {0.5 * normal * (before.x() + after.x()), 0.5 * friction * (before.y() + after.y())};
}

double pressing(const ContactPoint& touch, const Eigen::Vector3d& acceleration) {
  const double whirl = touch.whirl_speed();
  return touch.e_r.dot(acceleration.head<2>()) + whirl * whirl / touch.delta;
}

double restitution_beside_loads(double restitution, double approach, double load, double compression_time,
                                double expansion_time) {
  const double compressed = load * compression_time, expanded = load * expansion_time;
  if (!(compressed > 0.0)) return restitution;
  const double back = std::max(0.0, restitution * (approach + compressed) - expanded);
  const double again = std::sqrt(back * (back + 2.0 * expanded));
  if (again <= 0.5 * (1.0 + restitution) * approach) return restitution;
  return restitution * approach / (approach + compressed);
}

}  // namespace rotorub
