// The controller's command for a fixed step, with its memory: the command that is held between the
// samples of a sampled controller, or between the steps for a continuous one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "native_model/model/actuation.h"
#include "native_model/stepping/fixed_step.h"

namespace rotorub {

class ZeroOrderHold {
 public:
  // The model must outlive this object.
  explicit ZeroOrderHold(const Model& model, std::size_t bearing = 0)
      : model_(&model), bearing_(bearing), sampled_(model, bearing) {}

  // The actuator's command (model/actuation.h) over the step that starts at t (s), from the state
  // there. Call it once per step, in order. It is 0 without a controller and before the controller
  // is on.
  const Eigen::Vector2d& at(double t, const double* q, const double* v);

  // The mean of the command over begin..end about t, from q, v and the accelerations at t (nq
  // values each). A command that jumps there, at a sample or when the controller is switched on, is
  // taken from the state of that instant and weighted by the time for which it holds. For magnets
  // without a coil lag it is the currents of the mean force. Call it in order.
  Eigen::Vector2d mean(double begin, double t, double end, const double* q, const double* v,
                       const double* a);
  // The first jump of the command in the last mean().
  const CommandJump& command_jump() const { return command_jump_; }
  // True if mean() would use the state.
  bool needs_state(double end) const;
  // Outputs of a sampled law at its last sample (ActuatorState::outputs).
  std::array<double, kMostOutputs> outputs() const { return sampled_.outputs(); }
  // The reason why the law failed; empty if it did not. The last command stays valid.
  const std::string& failure() const { return sampled_.failure(); }
  // The command that holds after the last call.
  const Eigen::Vector2d& held() const { return held_; }

  // Sets the coil currents (A) that the controller measures. Call it if the currents lag, but the
  // caller and not the stepper computes them (plugin/contact/verlet.cc). By default the controller
  // measures the model's coil currents, or the held currents.
  void show_currents(const Eigen::Vector2d& now) { currents_ = now; }

  // The complete memory as plain numbers.
  static std::size_t memory_size(const Model& model);
  void save(double* to) const;
  void restore(const double* from);

 private:
  Eigen::Vector2d command(double t, const double* q, const double* v);
  double next_sample() const;
  const AuxiliaryBearing& bearing() const { return model_->auxiliary[bearing_]; }

  const Model* model_;
  std::size_t bearing_;
  Eigen::Vector2d held_{0.0, 0.0};
  CommandJump command_jump_;
  double last_sample_ = -1.0;  // index of the held sample; -1: none yet
  SampledCommand sampled_;
  std::optional<Eigen::Vector2d> currents_;
};

}  // namespace rotorub
