// Sliding mode with boundary layer, (22)-(29) of the paper: the ring tracks the rotor at the gap
// reference g_d(t), which falls smoothly from the clearance at switch-on to 0.
//
//   q_fd = r_rotor - (delta_0 - g_d) e_r,    e = q_f - q_fd = (g_N - g_d) e_r
//   s = edot + psi e
//   u = M_f (-f + qddot_fd - psi edot - k sat(s / phi)),   M_f f = -D_f qdot_f - K_f q_f
//
// With the gap closed a small preload P presses the ring on the rotor: tracking alone would leave the
// two grazing, without a force to speak of. It comes in as the reference falls. The rotor's
// acceleration is that without contact force, and a force lambda takes lambda w_r from it (w_r, w_f:
// mobilities e_r . M^-1 e_r of rotor and ring). In lasting contact both accelerate alike,
//   qddot_r - lambda w_r = qddot_r - u_P w_f + lambda w_f,
// so the actuator gives u_P = P (1 + w_r / w_f), and lambda = P. With u_P = P it would be
// P / (1 + w_r / w_f): a force that falls without end with the modes that the model keeps.
//
// (25) and (28) add accelerations to forces; the law above has the one unit. The error is radial
// by construction, so only the normal direction is driven: e_r . qddot_fd follows from the rotor's
// contact-free acceleration and the whirl, e_r . qddot_f = e_r . rddot + v_t^2 / delta + gddot_N.
#pragma once

#include "native_model/control/controller.h"

namespace rotorub {

class SlidingController final : public Controller {
 public:
  SlidingController(const scene::Controller& settings, const Plant& plant);
  Eigen::Vector2d force(const Measurement& measurement) const override;
  bool needs_rotor_acceleration() const override { return true; }
  Gains ring_gains() const override;
  std::vector<double> breaks() const override { return {settings_.on + settings_.gap_time}; }

  // Gap reference and its first two derivatives at time t: delta_0 (1 - 10 s^3 + 15 s^4 - 6 s^5),
  // s = (t - on) / gap_time in [0, 1].
  struct Reference {
    double gap, rate, acceleration;  // m, m/s, m/s^2
  };
  Reference reference(double t) const;

 private:
  scene::Controller settings_;
  Plant plant_;
};

}  // namespace rotorub
