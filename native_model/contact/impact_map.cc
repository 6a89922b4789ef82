#include "native_model/contact/impact_map.h"

namespace rotorub {
namespace {

struct Rows {
  Eigen::Vector3d normal, tangential;
};

// W_N and W_T in contact space, plus tau What of the velocity at the start of the phase.
Rows rows(const ImpactInput& in, const Eigen::Vector3d& velocity, double tau) {
  const Eigen::Vector2d& e = in.e_r;
  const Eigen::Vector2d t{-e.y(), e.x()};
  Rows r{{-e.x(), -e.y(), 0.0}, {t.x(), t.y(), in.radius}};
  if (tau == 0.0) return r;
  const double whirl = t.dot(velocity.head<2>()), gap_rate = -e.dot(velocity.head<2>());
  r.normal.head<2>() -= tau * whirl / in.delta * t;
  r.tangential.head<2>() += tau * gap_rate / in.delta * t;
  return r;
}

ImpactPhase phase(const ImpactInput& in, const Rows& w, const Rows& row,
                  const Eigen::Vector3d& end_velocity) {
  const Eigen::Vector3d an = in.admittance * w.normal, at = in.admittance * w.tangential;
  return {{row.normal.dot(an), row.normal.dot(at), row.tangential.dot(an), row.tangential.dot(at)},
          row.normal.dot(end_velocity),
          row.tangential.dot(end_velocity)};
}

}  // namespace

ImpactResult solve_impact(const ImpactInput& in, const ImpactLaw& law) {
  const Rows w = rows(in, in.velocity, 0.0);
  if (in.compression_time == 0.0 && in.expansion_time == 0.0) {
    const Delassus g = delassus(in.admittance, in.e_r, in.radius);
    return solve_impact(g, w.normal.dot(in.velocity), w.tangential.dot(in.velocity), law);
  }
  const Rows c = rows(in, in.velocity, in.compression_time);
  ImpactResult r =
      compress(phase(in, w, c, in.velocity + in.acceleration * in.compression_time), law);
  const Eigen::Vector3d compressed =
      in.velocity + in.acceleration * in.compression_time +
      in.admittance * (w.normal * r.normal_compression + w.tangential * r.friction_compression);
  const Rows e = rows(in, compressed, in.expansion_time);
  expand(phase(in, w, e, compressed + in.acceleration * in.expansion_time), law, r);
  return r;
}

}  // namespace rotorub
