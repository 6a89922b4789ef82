// Forces on rings beyond springs and dampers to the base.

#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

Eigen::Vector2d pair_at(const double* x, int at) {
  return at == kAbsent ? Eigen::Vector2d(0.0, 0.0) : Eigen::Vector2d(x[at], x[at + 1]);
}

}  // namespace

void add_ring_supports(const Model& m, const double* q, const double* v, double* f) {
  for (const StationSupport& s : m.supports) {
    const Eigen::Vector2d ring = pair_at(q, s.ring), housing = pair_at(q, s.housing);
    const Eigen::Vector2d rate = pair_at(v, s.ring), housing_rate = pair_at(v, s.housing);
    const Eigen::Vector2d r = ring - housing, w = rate - housing_rate;
    const Eigen::Vector2d bristle = pair_at(v, s.bristle);
    const Eigen::Vector2d law_force = s.law.force(r, w, bristle);
    // The diagonals contain -k r_ring for the ring and -k r_housing for the housing.
    for (int k = 0; k < 2; ++k) {
      f[s.ring + k] += law_force[k];
      if (s.housing == kAbsent) continue;
      f[s.ring + k] += s.stiffness[k] * housing[k] + s.damping[k] * housing_rate[k];
      f[s.housing + k] += s.stiffness[k] * ring[k] + s.damping[k] * rate[k] - law_force[k];
    }
    if (s.bristle != kAbsent) {
      const Eigen::Vector2d rising = bristle_rate(w, bristle, s.law.dry->presliding);
      for (int k = 0; k < 2; ++k) f[s.bristle + k] += m.mass[s.bristle + k] * rising[k];
    }
    if (s.spin_bristle == kAbsent) continue;
    const Eigen::Vector2d load =
        law_force - s.stiffness.cwiseProduct(r) - s.damping.cwiseProduct(w);
    const double state = v[s.spin_bristle];
    f[s.ring_angle] -= s.law.drag_torque(load.norm()) * state;
    f[s.spin_bristle] +=
        m.mass[s.spin_bristle] * bristle_rate(v[s.ring_angle], state, s.law.drag->presliding_angle);
  }
}

void step_bristles(const Model& m, const double* v, const double* from, double h, double* f) {
  for (const StationSupport& s : m.supports) {
    if (s.bristle != kAbsent) {
      const Eigen::Vector2d w = pair_at(v, s.ring) - pair_at(v, s.housing);
      const Eigen::Vector2d begin = pair_at(from, s.bristle);
      const Eigen::Vector2d end = bristle_after(w, w.norm(), begin, s.law.dry->presliding, h);
      for (int k = 0; k < 2; ++k) {
        f[s.bristle + k] = m.mass[s.bristle + k] * (end[k] - begin[k]) / h;
      }
    }
    if (s.spin_bristle == kAbsent) continue;
    const double w = v[s.ring_angle], begin = from[s.spin_bristle];
    const double end = bristle_after(w, std::abs(w), begin, s.law.drag->presliding_angle, h);
    f[s.spin_bristle] = m.mass[s.spin_bristle] * (end - begin) / h;
  }
}

double coupling_power(const Model& m, const double* q, const double* v) {
  double power = 0.0;
  for (const StationSupport& s : m.supports) {
    for (int k = 0; s.housing != kAbsent && k < 2; ++k) {
      power +=
          s.stiffness[k] * (q[s.housing + k] * v[s.ring + k] + q[s.ring + k] * v[s.housing + k]);
    }
  }
  return power;
}

}  // namespace rotorub
