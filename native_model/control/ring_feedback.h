// Feedback of the ring's own motion.
#pragma once

#include <vector>

#include "native_model/control/controller.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

// A passive bearing with an additional spring and damper emulated through the actuator.
class EmulatedSupport final : public Controller {
 public:
  EmulatedSupport(double stiffness, double damping) : stiffness_(stiffness), damping_(damping) {}
  Eigen::Vector2d command(const Measurement& now, const SwitchOn&, double*) const override {
    return -stiffness_ * now.stator - damping_ * now.stator_velocity;
  }
  Gains ring_gains() const override { return {stiffness_, damping_}; }

 private:
  double stiffness_;  // N/m, >= 0
  double damping_;    // N s/m, >= 0
};

// Cross-coupled feedback of the ring's velocity (paper, section 4), with an additional damping (0
// in the paper):
//
//   u = -k(Omega) sign(Omega) e_z x q_f' - d q_f'
//
// The first term does no work. Like a gyroscope it splits the whirl of the ring into a forward and
// a backward whirl, and so moves the rub away from the frequencies that friction drives; a large k
// drives other frequencies. The second term widens the window between them. `rotorub modes
// --feedback-map` shows k and d by the closed-loop eigenvalues.
class CrossCoupled final : public Controller {
 public:
  explicit CrossCoupled(const scene::Controller& settings)
      : gain_(settings.feedback), speed_(settings.feedback_speed), damping_(settings.damping) {}
  Eigen::Vector2d command(const Measurement& now, const SwitchOn&, double*) const override;
  Gains ring_gains() const override;
  // k, N s/m, at a spin speed (rad/s, either sign): linear between the speeds of the table,
  // constant beyond them.
  double gain(double spin_speed) const;

 private:
  std::vector<double> gain_, speed_;
  double damping_;  // N s/m, d
};

}  // namespace rotorub
