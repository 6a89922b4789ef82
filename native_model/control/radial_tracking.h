// Laws that move the ring towards the rotor along the line of centres, from measured quantities:
//
//   d = q_r - q_f = delta e_r,   e = g_N - g_d = delta_0 - delta - g_d,   e' = -e_r . d' - g_d'.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "native_model/control/controller.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

// Gap reference of a tracking law. It goes smoothly from the gap at switch-on to 0:
//
//   g_d = g_0 H_0(s) + T g_0' H_1(s),   s = (t - on) / T in [0, 1],
//
// with the quintic polynomials of value and slope, r = 1 - s: H_0 = r^3 (1 + 3 s + 6 s^2) and
// H_1 = r^3 s (1 + 3 s). Their first two derivatives are 0 at s = 1, and the second also at s = 0.
// The slope T g_0' is limited to [-2.5 g_0, 2.5 min(g_0, delta_0 - g_0)]. The lower limit keeps
// g_d >= 0. The upper limit keeps the requested distance of the centres, delta_0 - g_d, above half
// its value at switch-on, because H_1 <= 0.198. A gap beyond the clearance would ask for a negative
// distance, and the ring would be held at the centre.
struct GapReference {
  double gap, rate, acceleration;  // m, m/s, m/s^2
  double share;                    // completed share, 1 - H_0, in [0, 1]
};

// t: s; time: T, s, > 0; clearance: delta_0, m.
GapReference gap_reference(const SwitchOn& on, double t, double time,
                           double clearance = std::numeric_limits<double>::infinity());

// Errors of a tracking law in polar coordinates.
struct RadialError {
  Eigen::Vector2d e_r{1.0, 0.0};
  double delta = 0.0;        // m
  double whirl_speed = 0.0;  // m/s, e_t . d'
  // m/s^2, whirl_speed^2 / delta: delta'' exceeds e_r . d'' by this.
  double centrifugal = 0.0;
  double certainty = 1.0;  // confidence in e_r, in [0, 1]; 0 at the centre
  double error = 0.0;      // m, e
  double rate = 0.0;       // m/s, e'
  GapReference wanted{};
};

// Empty if the rotor is centred in the ring, because e_r is then undefined.
std::optional<RadialError> radial_error(const Measurement& now, const SwitchOn& on,
                                        double clearance, double gap_time);

// The command of a tracking law is along e_r, which turns with the whirl. It takes effect late by
// command_lead(): the delay of the sensors, half a sample (the mean age of a held command) and the
// lag of the coils. turned_ahead() therefore turns the command by the whirl during that time.
// Otherwise a force M_f q_r'' that rotates at omega would have a sideways component of the share
// omega tau; at 50 Hz and 0.1 ms this is three times the preload of the reference rig.
inline double command_lead(const scene::Controller& c, const Plant& plant) {
  return c.sensors.delay + 0.5 * c.sample_time + plant.coil_lag;  // s
}
Eigen::Vector2d turned_ahead(const Eigen::Vector2d& u, const RadialError& r, double lead);

// The ratio u_P / P for a preload P along e_r (sliding.h): 1 + w_r / w_f.
double preload_share(const Plant& plant, const Eigen::Vector2d& e_r);

// A spring and a damper between the ring and the position at which it has the reference gap:
//
//   u = -(stiffness e + damping e' + P (1 + w_r / w_f) (1 - H_0)) e_r,
//
// P is the preload of sliding.h. For a rotor at rest the closed loop is
//   M_f e'' + (D_f + damping) e' + (K_f + stiffness) e = 0.
class TrackingPd final : public Controller {
 public:
  TrackingPd(const scene::Controller& settings, const Plant& plant)
      : settings_(settings), plant_(plant), lead_(command_lead(settings, plant)) {}
  Eigen::Vector2d command(const Measurement& now, const SwitchOn& on, double*) const override;
  Gains ring_gains() const override { return {settings_.stiffness, settings_.damping}; }
  std::vector<double> breaks(double on) const override { return {on + settings_.gap_time}; }

 private:
  scene::Controller settings_;
  Plant plant_;
  double lead_;  // s
};

// Throws scene::SceneError at the controller.sample_time of an auxiliary bearing if the command of
// a sampled law is so late that the contact would chatter; the message gives the largest accepted
// sample time.
void refuse_delay(const scene::Scene& scene, std::size_t bearing, const Plant& plant,
                  const Controller& law);

}  // namespace rotorub
