// The paper's own law: sliding mode brings the ring to the rotor (sliding.h), and after the first
// small impact cross-coupled feedback takes over (cross_coupled.h). At the hand-over, t_h, what the
// first law asked and the second does not fades out, so that the force does not jump:
//
//   u = u_cross(t) + (u_track(t_h) - u_cross(t_h)) (1 - H((t - t_h) / T_h)),
//
// H the smooth step of gap_reference.h. An impact is seen as the sensors see it (touch.h).
#pragma once

#include "native_model/control/cross_coupled.h"
#include "native_model/control/sliding.h"

namespace rotorub {

class TwoPhase final : public Controller {
 public:
  TwoPhase(const scene::Controller& settings, const Plant& plant, double spin_speed = 0.0);
  std::size_t state_size() const override;
  void start(double* state) const override;
  Eigen::Vector2d command(const Measurement& now, const SwitchOn& on, double* state) const override;
  bool needs_rotor_acceleration() const override { return true; }
  Gains ring_gains() const override { return track_.ring_gains(); }

 private:
  SlidingController track_;
  CrossCoupled cross_;
  double clearance_;      // m
  double handover_time_;  // s, T_h
};

}  // namespace rotorub
