#include "native_model/control/radial_tracking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "native_model/contact/kinematics.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

// s: the largest accepted command_lead() with these gains. On a ring of mass M the loop gain is
// (d s + k)/(M s^2). Its magnitude is 1 at
//
//   w_c^2 = (D^2 + sqrt(D^4 + 4 K^2)) / 2,   D = d/M, K = k/M.
//
// There a delay T costs the phase w_c T, and beyond 1 rad the contact chatters (measured on the
// reference rig, where w_c is 5,600 rad/s: 175 us are stable, 200 us chatter). Infinity without
// gains.
double largest_lead(const Controller::Gains& gains, double ring_mass) {
  const double d = gains.damping / ring_mass, k = gains.stiffness / ring_mass;
  const double square = 0.5 * (d * d + std::sqrt(d * d * d * d + 4.0 * k * k));
  return square > 0.0 ? 1.0 / std::sqrt(square) : std::numeric_limits<double>::infinity();
}

}  // namespace

GapReference gap_reference(const SwitchOn& on, double t, double time, double clearance) {
  const double s = std::clamp((t - on.t) / time, 0.0, 1.0), r = 1.0 - s;
  const double cube = r * r * r;
  const double value = cube * (1.0 + 3.0 * s + 6.0 * s * s);
  const double fall = -30.0 * s * s * r * r, curve = -60.0 * s * r * (r - s);
  const double gap = std::max(on.gap, 0.0);
  const double most = std::clamp(clearance - gap, 0.0, gap);
  const double slope = std::clamp(time * on.gap_rate, -2.5 * gap, 2.5 * most);
  if (slope == 0.0)
    return {gap * value, gap * fall / time, gap * curve / (time * time), 1.0 - value};
  const double rise = cube * s * (1.0 + 3.0 * s);
  const double rise_rate = 1.0 - s * s * (18.0 - s * (32.0 - 15.0 * s));
  const double rise_curve = -s * (36.0 - s * (96.0 - 60.0 * s));
  return {gap * value + slope * rise, (gap * fall + slope * rise_rate) / time,
          (gap * curve + slope * rise_curve) / (time * time), 1.0 - value};
}

std::optional<RadialError> radial_error(const Measurement& now, const SwitchOn& on,
                                        double clearance, double gap_time) {
  const Eigen::Vector2d d = now.rotor - now.stator;
  RadialError r;
  r.delta = d.norm();
  if (r.delta <= kNoNormal) return std::nullopt;
  r.e_r = d / r.delta;
  const Eigen::Vector2d dv = now.rotor_velocity - now.stator_velocity;
  r.whirl_speed = -r.e_r.y() * dv.x() + r.e_r.x() * dv.y();
  // Near the centre e_r turns by half a turn at once, so the law must not depend on it there. A
  // force along e_r would hold the ring at the centre, and so would the full centrifugal term of a
  // passage beside the centre.
  const double middle = 0.1 * clearance;
  r.certainty = std::min(1.0, r.delta / middle);
  r.centrifugal = r.whirl_speed * r.whirl_speed / std::max(r.delta, middle);
  r.wanted = gap_reference(on, now.t, gap_time, clearance);
  r.error = clearance - r.delta - r.wanted.gap;
  r.rate = -r.e_r.dot(dv) - r.wanted.rate;
  return r;
}

Eigen::Vector2d turned_ahead(const Eigen::Vector2d& u, const RadialError& r, double lead) {
  constexpr double kMost = 0.5;  // rad; near the centre the direction is meaningless
  const double angle = std::clamp(r.whirl_speed / r.delta * lead, -kMost, kMost);
  if (angle == 0.0) return u;
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * u.x() - s * u.y(), s * u.x() + c * u.y()};
}

double preload_share(const Plant& plant, const Eigen::Vector2d& e_r) {
  const Eigen::Vector2d square = e_r.cwiseAbs2();
  return 1.0 + square.dot(plant.rotor_mobility) / square.dot(plant.stator_mass.cwiseInverse());
}

Eigen::Vector2d TrackingPd::command(const Measurement& now, const SwitchOn& on, double*) const {
  const auto r = radial_error(now, on, plant_.clearance, settings_.gap_time);
  if (!r) return {0.0, 0.0};
  const double preload = settings_.preload * preload_share(plant_, r->e_r) * r->wanted.share;
  return turned_ahead(
      -(settings_.stiffness * r->error + settings_.damping * r->rate + preload) * r->e_r, *r,
      lead_);
}

void refuse_delay(const scene::Scene& scene, std::size_t bearing, const Plant& plant,
                  const Controller& law) {
  using scene::number_text;
  const scene::Controller& c = *scene.auxiliary[bearing].controller;
  if (c.sample_time <= 0.0) return;
  const double lead = command_lead(c, plant);
  const double most = largest_lead(law.ring_gains(), plant.stator_mass.maxCoeff());
  if (lead <= most) return;
  const double sample = c.sample_time - 2.0 * (lead - most);
  const std::string less = "a smaller `bandwidth` or `switching_gain`/`boundary_layer`";
  scene::refuse_at(scene, bearing, "controller.sample_time",
                   "half of it, delay and coil_lag make the command " + number_text(lead) +
                       " s late, and with these gains it would chatter beyond " +
                       number_text(most) + " s; set " +
                       (sample > 0.0 ? "at most " + number_text(sample) + " s, or " + less : less));
}

}  // namespace rotorub
