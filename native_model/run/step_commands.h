// The commands of the rings, step by step: of controllers, held between their samples, or those of
// another run.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "native_model/contact/most_contacts.h"
#include "native_model/model/model.h"
#include "native_model/stepping/stepper.h"
#include "native_model/stepping/zero_order_hold.h"

namespace rotorub {

class StepCommands {
 public:
  // Both must outlive it. step: s.
  StepCommands(const Model& model, FixedStepper& stepper, double step);

  // Of step k, from t_k to t_{k+1}: held over it.
  void hold(std::int64_t k);
  // The mean over (t_k - h/2, t_k + h/2), for a stepper that leaps.
  void mean_about(std::int64_t k);

  // Over the step, and as they stand at the state's time; N or A of each ring.
  std::span<const Eigen::Vector2d> of_step() const { return all(command_); }
  const Eigen::Vector2d& shown(std::size_t ring) const { return shown_[ring]; }
  std::array<double, kMostOutputs> outputs(std::size_t ring) const {
    return holds_[ring].outputs();
  }
  // Why a controller has failed, with its time; empty: none has.
  const std::string& failure() const { return failure_; }

 private:
  using Commands = std::array<Eigen::Vector2d, kMaxContacts>;
  static Commands none() {
    Commands all;
    all.fill(Eigen::Vector2d(0.0, 0.0));
    return all;
  }
  std::span<const Eigen::Vector2d> all(const Commands& of) const {
    return std::span(of).first(holds_.size());
  }
  double time(std::int64_t k) const { return static_cast<double>(k) * step_; }
  void find_velocities(std::int64_t k);
  void listen(const ZeroOrderHold& hold) {
    if (failure_.empty()) failure_ = hold.failure();
  }

  const Model& model_;
  FixedStepper& stepper_;
  double step_;
  std::vector<ZeroOrderHold> holds_;
  Commands command_ = none(), shown_ = none();
  std::vector<double> velocity_, acceleration_;
  std::string failure_;
};

}  // namespace rotorub
