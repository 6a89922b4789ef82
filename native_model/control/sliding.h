// Sliding mode with boundary layer, (22)-(29) of the paper: the ring tracks the rotor at the gap
// reference g_d(t), which falls smoothly from the gap at switch-on to 0 (radial_tracking.h).
//
//   q_fd = r_rotor - (delta_0 - g_d) e_r,    e = q_f - q_fd = (g_N - g_d) e_r
//   s = edot + psi e
//   u = M_f (-f + qddot_fd - psi edot - k sat(s / phi)),   M_f f = -D_f qdot_f - K_f q_f
//
// With the gap closed a small preload P presses the ring on the rotor: tracking alone would leave
// the two grazing, without a force to speak of. It comes in as the reference falls. The rotor's
// acceleration is that without contact force, and a force lambda takes lambda w_r from it (w_r,
// w_f: mobilities e_r . M^-1 e_r of rotor and ring). In lasting contact both accelerate alike,
//   qddot_r - lambda w_r = qddot_r - u_P w_f + lambda w_f,
// so the actuator gives u_P = P (1 + w_r / w_f), and lambda = P. With u_P = P it would be
// P / (1 + w_r / w_f): a force that falls without end with the modes that the model keeps.
//
// The layer of (27), `adaptive`: phi' + psi phi = k and psi phi in the place of k, so that within
// it the error has the double pole psi whatever k is, and phi comes to k / psi. The state is phi.
//
// Sampled, what is known of the plant comes late by tau: the feed-forward of a mode's acceleration,
// -M_f omega^2 q(t - tau), is a negative damping M_f omega^2 tau, at 1.5 kHz and 10 us more than
// any bearing has, and the contact chatters. So a sampled law takes the mean of it in the frame of
// the whirl, where what is steady stands still (`filter_time`, standard one turn), and gives back
// the damping of all that does not stand still there, which the law would cancel and friction
// needs: -d (q_f' - mean) (`tracking_damping`, standard the ring's critical one). A continuous law
// is the equations above.
//
// (25) and (28) add accelerations to forces; the law above has the one unit. The error is radial
// by construction, so only the normal direction is driven: e_r . qddot_fd follows from the rotor's
// contact-free acceleration and the whirl, e_r . qddot_f = e_r . rddot + v_t^2 / delta + gddot_N.
#pragma once

#include "native_model/control/controller.h"
#include "native_model/control/ring_feedback.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

struct RadialError;  // radial_tracking.h

class SlidingController final : public Controller {
 public:
  // spin_speed: rad/s, at the start; its turn is the standard filter time.
  SlidingController(const scene::Controller& settings, const Plant& plant, double spin_speed = 0.0);
  std::size_t state_size() const override;
  void start(double* state) const override;
  Eigen::Vector2d command(const Measurement& now, const SwitchOn& on, double* state) const override;
  std::span<const Output> outputs() const override;
  void output(const Measurement& now, const SwitchOn& on, const double* state,
              double* values) const override;
  bool needs_rotor_acceleration() const override { return true; }
  Gains ring_gains() const override;
  std::vector<double> breaks(double on) const override { return {on + settings_.gap_time}; }

 private:
  enum Means : std::size_t { kBegun, kForward, kRadial, kTangential, kMeans };
  bool filters() const { return filter_time_ > 0.0; }
  double forward(const Measurement& now, const RadialError& r) const;
  void filter(double forward, const Eigen::Vector2d& ring, double* means) const;
  bool adapts() const { return settings_.layer == scene::BoundaryLayer::kAdaptive; }
  double surface(const RadialError& r) const;

  scene::Controller settings_;
  Plant plant_;
  double lead_;               // s
  double filter_time_ = 0.0;  // s; 0: none
  double damping_ = 0.0;      // N s/m
};

// The paper's own law: sliding mode brings the ring to the rotor, and after the first small impact
// cross-coupled feedback takes over (ring_feedback.h). At the hand-over, t_h, what the
// first law asked and the second does not fades out, so that the force does not jump:
//
//   u = u_cross(t) + (u_track(t_h) - u_cross(t_h)) (1 - H((t - t_h) / T_h)),
//
// H the smooth step of the gap reference. An impact is seen as the sensors see it: touched(),
// control_loop.h.
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
