// Laws that bring the ring to the rotor along the line of centres, by measured quantities:
//
//   d = q_r - q_f = delta e_r,   e = g_N - g_d = delta_0 - delta - g_d,   e' = -e_r . d' - g_d'.
#pragma once

#include <limits>
#include <optional>

#include "native_model/control/controller.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

// The gap that a tracking law wants: from the one at switch-on smoothly to 0.
//
//   g_d = g_0 H_0(s) + T g_0' H_1(s),   s = (t - on) / T in [0, 1],
//
// with the quintics of value and slope, r = 1 - s: H_0 = r^3 (1 + 3 s + 6 s^2) and
// H_1 = r^3 s (1 + 3 s), whose first two derivatives are 0 at s = 1, and the second at s = 0 too.
// It is never below 0 for T g_0' >= -2.5 g_0; a gap that closes faster is met at that slope. One
// that opens is met at T g_0' <= 2.5 g_0, and 2.5 (delta_0 - g_0): as H_1 <= 0.198, the distance of
// the centres delta_0 - g_d that is asked for never falls below half of that at switch-on. Beyond
// the clearance it would be negative: no direction has it, and the ring would be held at the
// centre.
struct GapReference {
  double gap, rate, acceleration;  // m, m/s, m/s^2
  double share;                    // of the way done, H = 1 - H_0, in [0, 1]
};

// At t (s); time: T, s, > 0; clearance: delta_0, m.
GapReference gap_reference(const SwitchOn& on, double t, double time,
                           double clearance = std::numeric_limits<double>::infinity());

// What such a law sees.
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
std::optional<RadialError> radial_error(const Measurement& now, const SwitchOn& on,
                                        double clearance, double gap_time);

// What a tracking law asks is along e_r, which turns with the whirl. It acts late: by the delay of
// the sensors, the half of a sample that a held command is old on the mean, and the coils' lag.
// Asked for the direction of then, it does not pull sideways: of a force M_f q_r'' that turns at
// omega a part omega tau is saved, at 50 Hz and 0.1 ms three times the preload of the reference
// rig.
inline double command_lead(const scene::Controller& c, const Plant& plant) {
  return c.sensors.delay + 0.5 * c.sample_time + plant.coil_lag;  // s
}
Eigen::Vector2d turned_ahead(const Eigen::Vector2d& u, const RadialError& r, double lead);

// u_P / P of a preload P along e_r (sliding.h): 1 + w_r / w_f.
double preload_share(const Plant& plant, const Eigen::Vector2d& e_r);

// A spring and a damper between the ring and the place at which it would have the wanted gap:
//
//   u = -(stiffness e + damping e' + P (1 + w_r / w_f) (1 - g_d / g_0)) e_r,
//
// P the preload of sliding.h. Towards a rotor at rest the closed loop is
// M_f e'' + (D_f + damping) e' + (K_f + stiffness) e = 0.
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

// How late a tracking law may act before its contact chatters: throws scene::SceneError at
// controller.sample_time, with the one that is needed, where a sampled law is later.
void refuse_lateness(const scene::Scene& scene, const Plant& plant, const Controller& law);

}  // namespace rotorub
