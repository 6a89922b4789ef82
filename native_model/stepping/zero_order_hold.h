// The controller's command to a fixed step, and its memory: what is held between the samples of a
// sampled controller, and of a continuous one between the steps.
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
  // The model must outlive the hold.
  explicit ZeroOrderHold(const Model& model, std::size_t bearing = 0)
      : model_(&model), bearing_(bearing), sampled_(model, bearing) {}

  // The actuator's command (model/actuation.h) over the step that starts at t (s), from the
  // state there; ask once a step, in order. 0 before the controller is on and without one.
  const Eigen::Vector2d& at(double t, const double* q, const double* v);

  // The mean of the command over begin..end about t, from q, v and the accelerations of t (nq
  // values each): a command that jumps there, at a sample or when the controller is switched on, is
  // taken from the state of that instant and counts with the time that it holds; of currents of
  // magnets that do not lag, the ones of the mean force. Ask in order.
  Eigen::Vector2d mean(double begin, double t, double end, const double* q, const double* v,
                       const double* a);
  // Of the last mean(): where the command first jumped in it.
  const CommandJump& jump() const { return jump_; }
  // Whether mean() would look at the state.
  bool listens(double end) const;
  // Of a sampled law, at its last sample (ActuatorState::outputs).
  std::array<double, kMostOutputs> outputs() const { return sampled_.outputs(); }
  // Why the law failed; empty: it did not. Its last command stands.
  const std::string& failure() const { return sampled_.failure(); }
  // What holds after the last call.
  const Eigen::Vector2d& held() const { return held_; }

  // The currents that the sensors see, A: of a model without coils' coordinates, whose currents lag
  // all the same. Otherwise those of the coils, or the ones held.
  void show_currents(const Eigen::Vector2d& now) { currents_ = now; }

  // All that it remembers, as plain numbers.
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
  CommandJump jump_;
  double last_sample_ = -1.0;  // index of the sample held; -1: none yet
  SampledCommand sampled_;
  std::optional<Eigen::Vector2d> currents_;
};

}  // namespace rotorub
