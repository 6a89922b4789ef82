#include "native_model/control/sliding.h"

#include <algorithm>

#include "native_model/contact/kinematics.h"

namespace rotorub {

SlidingController::SlidingController(const scene::Controller& settings, const Plant& plant)
    : settings_(settings), plant_(plant) {}

SlidingController::Reference SlidingController::reference(double t) const {
  const double time = settings_.gap_time;
  const double s = std::clamp((t - settings_.on) / time, 0.0, 1.0);
  // With r = 1 - s the polynomial is r^3 (1 + 3 s + 6 s^2): never below 0, and 0 at the end.
  const double r = 1.0 - s, g0 = plant_.clearance;
  return {g0 * r * r * r * (1.0 + 3.0 * s + 6.0 * s * s), -g0 * 30.0 * s * s * r * r / time,
          -g0 * 60.0 * s * r * (r - s) / (time * time)};
}

// Within the layer s = edot + psi e is driven by k/phi: e'' = -(psi + k/phi) edot - psi (k/phi) e.
Controller::Gains SlidingController::ring_gains() const {
  const double mass = plant_.stator_mass.maxCoeff(), psi = settings_.bandwidth;
  const double slope = settings_.switching_gain / settings_.boundary_layer;
  return {mass * psi * slope, mass * (psi + slope)};
}

Eigen::Vector2d SlidingController::force(const Measurement& now) const {
  const Eigen::Vector2d d = now.rotor - now.stator;
  const double delta = d.norm();
  if (delta <= kNoNormal) return {0.0, 0.0};  // no direction to track
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
  // -f along e_r: what the ring's own spring and damper do to it is compensated.
  const Eigen::Vector2d own = plant_.stator_stiffness.cwiseProduct(now.stator) +
                              plant_.stator_damping.cwiseProduct(now.stator_velocity);
  const double compensation = e_r.dot(own.cwiseQuotient(plant_.stator_mass));
  const Eigen::Vector2d square = e_r.cwiseAbs2();
  const double ring_mobility = square.dot(plant_.stator_mass.cwiseInverse());
  const double share = 1.0 + square.dot(plant_.rotor_mobility) / ring_mobility;
  const double preload = settings_.preload * share * (1.0 - wanted.gap / plant_.clearance);
  return plant_.stator_mass.cwiseProduct((radial + compensation) * e_r) - preload * e_r;
}

}  // namespace rotorub
