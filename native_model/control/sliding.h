// Sliding mode with boundary layer, (22)-(29) of the paper: the ring tracks the rotor at the gap
// reference g_d(t), which falls smoothly from the gap at switch-on to 0 (radial_tracking.h).
//
//   q_fd = r_rotor - (delta_0 - g_d) e_r,    e = q_f - q_fd = (g_N - g_d) e_r
//   s = edot + psi e
//   u = M_f (-f + qddot_fd - psi edot - k sat(s / phi)),   M_f f = -D_f qdot_f - K_f q_f
//
// When the gap is closed, a small preload P presses the ring onto the rotor; tracking alone would
// leave them grazing, with hardly any force. It rises as the reference falls. The rotor's
// acceleration qddot_r in the law leaves out the contact force; a force lambda reduces it by
// lambda w_r (w_r, w_f: mobilities e_r . M^-1 e_r of rotor and ring). In lasting contact both
// accelerate alike,
//   qddot_r - lambda w_r = qddot_r - u_P w_f + lambda w_f,
// so with the actuator force u_P = P (1 + w_r / w_f) the contact force is lambda = P. With u_P = P
// it would be P / (1 + w_r / w_f), which falls without limit as the model keeps more modes.
//
// With the layer of (27), `adaptive`, phi' + psi phi = k, and psi phi replaces k. The error in the
// layer then has the double pole -psi whatever k is, and phi tends to k / psi. The state is phi.
//
// The information of a sampled law is late by tau. The feed-forward of a mode's acceleration,
// -M_f omega^2 q(t - tau), then acts as a negative damping M_f omega^2 tau. At 1.5 kHz and 10 us
// this exceeds the damping of any bearing, and the contact chatters. A sampled law therefore
// averages the feed-forward in the frame of the whirl, where a steady motion is constant
// (`filter_time`, default one turn). The law would also cancel the ring's own damping, which is
// needed against friction. A sampled law therefore adds damping to all motion that is not steady in
// that frame: -d (q_f' - mean) (`tracking_damping`, default the ring's critical damping). A
// continuous law uses the equations above.
//
// (25) and (28) of the paper add accelerations to forces; the law above has consistent units. The
// error is radial by construction, so only the normal direction is controlled: e_r . qddot_fd
// follows from the rotor's contact-free acceleration and the whirl, e_r . qddot_f =
// e_r . rddot + v_t^2 / delta + gddot_N.
#pragma once

#include "native_model/control/controller.h"
#include "native_model/control/ring_feedback.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

struct RadialError;  // radial_tracking.h

class SlidingController final : public Controller {
 public:
  // spin_speed: rad/s, at the start; the default filter time is one turn at this speed.
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
  double lead_;               // s, command_lead()
  double filter_time_ = 0.0;  // s; 0: no filter
  double damping_ = 0.0;      // N s/m, tracking damping d
};

// The paper's law: sliding mode brings the ring to the rotor, and cross-coupled feedback
// (ring_feedback.h) takes over after the first small impact. At the hand-over time t_h the
// difference between the two commands fades out, so that the force does not jump:
//
//   u = u_cross(t) + (u_track(t_h) - u_cross(t_h)) (1 - H((t - t_h) / T_h)),
//
// where H is the smooth step of the gap reference (GapReference::share). The impact is detected
// from the sensors: touched(), control_loop.h.
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
  double sample_time_;    // s
  double handover_time_;  // s, T_h
};

}  // namespace rotorub
