#include "native_model/contact/impact_phase.h"

#include <cassert>
#include <cstddef>

namespace rotorub {

Eigen::Vector2d rates_along(const Eigen::Vector2d& e_r, double radius,
                            const Eigen::Vector3d& velocity) {
  const Eigen::Vector2d e_t{-e_r.y(), e_r.x()};
  return {-e_r.dot(velocity.head<2>()), e_t.dot(velocity.head<2>()) + radius * velocity.z()};
}

void load_phase(double tau, std::span<const double> acceleration, std::span<const double> from,
                std::span<double> to) {
  assert(acceleration.size() == to.size() && from.size() == to.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + tau * acceleration[i];
}

void add_load_work(double tau, std::span<const double> force, const double* from, const double* to,
                   double& work) {
  for (std::size_t i = 0; i < force.size(); ++i) work += 0.5 * tau * force[i] * (from[i] + to[i]);
}

ImpulseWork impulse_work(double normal, double friction, const Eigen::Vector2d& before,
                         const Eigen::Vector2d& after) {
  return {0.5 * normal * (before.x() + after.x()), 0.5 * friction * (before.y() + after.y())};
}

}  // namespace rotorub
