#include "plugin/contact/rigid_step.h"

#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"

namespace rotorub::plugin {

bool reaches_ring(const RigidStep& step, double clearance) {
  return end_of(step).squaredNorm() > clearance * clearance;
}

Eigen::Vector2d contact_normal(const RigidStep& step, double clearance) {
  // The path includes the bend, which may close a gap that its rate opens.
  return normal_of_path(step.d, end_of(step) - step.d, clearance);
}

bool is_impact(const RigidStep& step, const Eigen::Vector2d& e_r, const ContactParameters& c) {
  const double closing = e_r.dot(step.free.head<2>());
  if (step.was_in_contact || closing <= 0.0) return false;
  Eigen::Vector3d acceleration = (step.free - step.start) / step.h;
  acceleration.head<2>() += 2.0 / (step.h * step.h) * step.bend;
  const double a = closing_acceleration(e_r, step.free, acceleration, c.clearance);
  return rebound_outlives_steps(step.h, c.restitution, closing, a);
}

// An existing penetration (a start inside the ring's wall) is not removed in one step, because it
// would turn into speed. A share kRecovery of it is removed, no faster than kRecoveryRate and
// kRecoveryShare allow, so that a deep start gains hardly any energy.
double gap_over_step(const RigidStep& step, const ContactParameters& c) {
  constexpr double kRecovery = 0.2;        // share of the depth that a step removes, in (0, 1]
  constexpr double kRecoveryRate = 2.0;    // 1/s, in clearances
  constexpr double kRecoveryShare = 0.01;  // share of the present speed
  const double gap = c.clearance - end_of(step).norm();
  const double depth = std::max(0.0, step.d.norm() - c.clearance);
  const double recovery = kRecovery * depth / step.h;
  const double fastest = kRecoveryRate * c.clearance + kRecoveryShare * step.free.head<2>().norm();
  if (recovery > fastest) return (gap + depth) / step.h - fastest;
  return (gap + (1.0 - kRecovery) * depth) / step.h;
}

}  // namespace rotorub::plugin
