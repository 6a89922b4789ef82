// A spring and a damper between the ring and the place at which it would have the wanted gap, along
// the line of centres (radial_tracking.h):
//
//   u = -(stiffness e + damping e' + P (1 + w_r / w_f) (1 - g_d / g_0)) e_r,
//
// P the preload of sliding.h. Towards a rotor at rest the closed loop is
// M_f e'' + (D_f + damping) e' + (K_f + stiffness) e = 0.
#pragma once

#include "native_model/control/radial_tracking.h"

namespace rotorub {

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

}  // namespace rotorub
