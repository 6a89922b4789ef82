#include "native_model/control/sliding.h"

#include <algorithm>

namespace rotorub {

SlidingController::SlidingController(const scene::Controller& settings, const Plant& plant)
    : settings_(settings), plant_(plant) {}

SlidingController::Reference SlidingController::reference(double t) const {
  const double time = settings_.gap_time;
  const double s = std::clamp((t - settings_.on) / time, 0.0, 1.0);
  const double s2 = s * s, g0 = plant_.clearance;
  return {g0 * (1.0 - s * s2 * (10.0 - 15.0 * s + 6.0 * s2)),
          -g0 * 30.0 * s2 * (1.0 - 2.0 * s + s2) / time,
          -g0 * 60.0 * s * (1.0 - 3.0 * s + 2.0 * s2) / (time * time)};
}

Eigen::Vector2d SlidingController::force(const Measurement& now) const {
  const Eigen::Vector2d d = now.rotor - now.stator;
  const double delta = d.norm();
  if (delta == 0.0) return {0.0, 0.0};  // no direction to track
  const Eigen::Vector2d e_r = d / delta, e_t{-e_r.y(), e_r.x()};
  const Eigen::Vector2d dv = now.rotor_velocity - now.stator_velocity;
  const Reference wanted = reference(now.t);
  const double error = plant_.clearance - delta - wanted.gap;
  const double error_rate = -e_r.dot(dv) - wanted.rate;
  const double s = error_rate + settings_.bandwidth * error;
  const double switching =
      settings_.switching_gain * std::clamp(s / settings_.boundary_layer, -1.0, 1.0);
  const double gap_acceleration = wanted.acceleration - settings_.bandwidth * error_rate - switching;
  const double whirl = e_t.dot(dv);
  const double radial =
      e_r.dot(now.rotor_acceleration) + whirl * whirl / delta + gap_acceleration;
  // M_f (-f): what the ring's own spring and damper do is compensated.
  const Eigen::Vector2d own = plant_.stator_stiffness.cwiseProduct(now.stator) +
                              plant_.stator_damping.cwiseProduct(now.stator_velocity);
  const double preload = settings_.preload * (1.0 - wanted.gap / plant_.clearance);
  return plant_.stator_mass.cwiseProduct(radial * e_r) + (e_r.dot(own) - preload) * e_r;
}

}  // namespace rotorub
