// Commands of the rings, step by step: from controllers, held between samples, or from another run.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "native_model/contact/contact_list.h"
#include "native_model/model/model.h"
#include "native_model/stepping/stepper.h"
#include "native_model/stepping/zero_order_hold.h"

namespace rotorub {

class StepCommands {
 public:
  // Both must outlive this object. step: s.
  StepCommands(const Model& model, FixedStepper& stepper, double step);

  // Sets the commands that are held over step k, from t_k to t_{k+1}.
  void hold(std::int64_t k);
  // Sets the mean commands over (t_k - h/2, t_k + h/2), for a leapfrog stepper.
  void mean_about(std::int64_t k);

  // Commands over the step, and at the time of the state; N, or A for magnets, of each ring.
  std::span<const Eigen::Vector2d> of_step() const { return all(command_); }
  const Eigen::Vector2d& shown(std::size_t ring) const { return shown_[ring]; }
  std::array<double, kMostOutputs> outputs(std::size_t ring) const {
    return holds_[ring].outputs();
  }
  // Reason and time of a controller's failure; empty if none has failed.
  const std::string& failure() const { return failure_; }

 private:
  using Commands = std::array<Eigen::Vector2d, kMaxContacts>;
  static Commands none() {
    Commands all;
    all.fill(Eigen::Vector2d(0.0, 0.0));
    return all;
  }
  std::span<const Eigen::Vector2d> all(const Commands& commands) const {
    return std::span(commands).first(holds_.size());
  }
  double time(std::int64_t k) const { return static_cast<double>(k) * step_; }
  void find_velocities(std::int64_t k);
  void note_failure(const ZeroOrderHold& hold) {
    if (failure_.empty()) failure_ = hold.failure();
  }

  const Model& model_;
  FixedStepper& stepper_;
  double step_;
  std::vector<ZeroOrderHold> holds_;
  bool idle_ = true;  // no ring has a command during the run
  Commands command_ = none(), shown_ = none();
  std::vector<double> velocity_, acceleration_;
  std::string failure_;
};

}  // namespace rotorub
