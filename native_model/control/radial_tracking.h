// What a law sees that brings the ring to the rotor along the line of centres, by measured
// quantities:
//
//   d = q_r - q_f = delta e_r,   e = g_N - g_d = delta_0 - delta - g_d,   e' = -e_r . d' - g_d'.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "native_model/contact/kinematics.h"
#include "native_model/control/controller.h"
#include "native_model/control/gap_reference.h"

namespace rotorub {

struct RadialError {
  Eigen::Vector2d e_r{1.0, 0.0};
  double delta = 0.0;        // m
  double whirl_speed = 0.0;  // m/s, e_t . d'
  // m/s^2, whirl_speed^2 / delta: by how much more the distance grows than e_r . d''.
  double centrifugal = 0.0;
  double certainty = 1.0;  // of e_r: falls to 0 at the centre
  double error = 0.0;      // m
  double rate = 0.0;       // m/s
  GapReference wanted{};
};

// Nothing for a centred rotor: it has no direction.
inline std::optional<RadialError> radial_error(const Measurement& now, const SwitchOn& on,
                                               double clearance, double gap_time) {
  const Eigen::Vector2d d = now.rotor - now.stator;
  RadialError r;
  r.delta = d.norm();
  if (r.delta <= kNoNormal) return std::nullopt;
  r.e_r = d / r.delta;
  const Eigen::Vector2d dv = now.rotor_velocity - now.stator_velocity;
  r.whirl_speed = -r.e_r.y() * dv.x() + r.e_r.x() * dv.y();
  // About the centre, where e_r turns by half a turn at once, no law may depend on it: a force
  // along it, or the whole of what a passage beside the centre bends the distance by, would hold
  // the ring there.
  const double middle = 0.1 * clearance;
  r.certainty = std::min(1.0, r.delta / middle);
  r.centrifugal = r.whirl_speed * r.whirl_speed / std::max(r.delta, middle);
  r.wanted = gap_reference(on, now.t, gap_time, clearance);
  r.error = clearance - r.delta - r.wanted.gap;
  r.rate = -r.e_r.dot(dv) - r.wanted.rate;
  return r;
}

// What a tracking law asks is along e_r, which turns with the whirl. It acts late: by the delay of
// the sensors, the half of a sample that a held command is old on the mean, and the coils' lag.
// Asked for the direction of then, it does not pull sideways: of a force M_f q_r'' that turns at
// omega a part omega tau is saved, at 50 Hz and 0.1 ms three times the preload of the reference
// rig.
inline double command_lead(const scene::Controller& c, const Plant& plant) {
  return c.sensors.delay + 0.5 * c.sample_time + plant.coil_lag;  // s
}
inline Eigen::Vector2d turned_ahead(const Eigen::Vector2d& u, const RadialError& r, double lead) {
  constexpr double kMost = 0.5;  // rad: near the middle the direction means nothing
  const double angle = std::clamp(r.whirl_speed / r.delta * lead, -kMost, kMost);
  if (angle == 0.0) return u;
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * u.x() - s * u.y(), s * u.x() + c * u.y()};
}

// u_P / P of a preload P along e_r (sliding.h): 1 + w_r / w_f.
inline double preload_share(const Plant& plant, const Eigen::Vector2d& e_r) {
  const Eigen::Vector2d square = e_r.cwiseAbs2();
  return 1.0 + square.dot(plant.rotor_mobility) / square.dot(plant.stator_mass.cwiseInverse());
}

}  // namespace rotorub
