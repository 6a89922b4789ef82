// A passive bearing with an extra spring and damper emulated through the actuator.
#pragma once

#include "native_model/control/controller.h"

namespace rotorub {

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

}  // namespace rotorub
