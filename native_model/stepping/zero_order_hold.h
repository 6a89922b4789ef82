// The controller's command to a fixed step, and its memory: what is held between the samples of a
// sampled controller, and of a continuous one between the steps.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "native_model/system/model.h"

namespace rotorub {

class ZeroOrderHold {
 public:
  // The model must outlive the hold.
  explicit ZeroOrderHold(const Model& model) : model_(&model) {}

  // What the actuator is told (system/actuation.h) over the step that starts at t (s), from the
  // state there; ask once a step, in order. 0 before the controller is on and without one.
  const Eigen::Vector2d& at(double t, const double* q, const double* v);

  // The mean of the command over begin..end about t, from q, v and the accelerations of t (nq
  // values each): a command that jumps there, at a sample or when the controller is switched on, is
  // taken from the state of that instant and counts with the time that it holds; of currents of
  // magnets that do not lag, the ones of the mean force. Ask in order.
  Eigen::Vector2d mean(double begin, double t, double end, const double* q, const double* v,
                       const double* a);
  // Whether mean() would look at the state.
  bool listens(double end) const;
  // What holds after the last call.
  const Eigen::Vector2d& held() const { return held_; }

  // All that it remembers, as plain numbers.
  static constexpr std::size_t kMemory = 3;
  void save(double* to) const;
  void restore(const double* from);

 private:
  double next_sample() const;
  double next_switch(double from, double end) const;

  const Model* model_;
  Eigen::Vector2d held_{0.0, 0.0};
  double last_sample_ = -1.0;  // index of the sample held; -1: none yet
};

}  // namespace rotorub
