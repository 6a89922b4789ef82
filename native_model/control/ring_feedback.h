// Feedback of the ring's own motion.
#pragma once

#include <vector>

#include "native_model/control/controller.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

// A passive bearing with an extra spring and damper emulated through the actuator.
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

// Cross-coupled feedback of the ring's velocity (paper, section 4), with a damping beside it (0:
// the paper's):
//
//   u = -k(Omega) sign(Omega) e_z x q_f' - d q_f'
//
// The first does no work: it splits the ring's whirl into a forward and a backward one, as a
// gyroscope does, and so moves the rub away from the frequencies that friction drives; with a large
// k it drives others. The second widens the window between. k and d from the closed-loop
// eigenvalues: `rotorub modes --feedback-map`.
class CrossCoupled final : public Controller {
 public:
  explicit CrossCoupled(const scene::Controller& settings)
      : gain_(settings.feedback), speed_(settings.feedback_speed), damping_(settings.damping) {}
  Eigen::Vector2d command(const Measurement& now, const SwitchOn&, double*) const override;
  Gains ring_gains() const override;
  // k, N s/m, at a spin speed (rad/s, either sign): between the speeds of the table linear, beyond
  // them constant.
  double gain(double spin_speed) const;

 private:
  std::vector<double> gain_, speed_;
  double damping_;  // N s/m, d
};

}  // namespace rotorub
