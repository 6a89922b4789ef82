// The controller's command to a fixed-step integrator: one value a step, taken from the state at
// the step's start, and held between the samples of a sampled controller.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "native_model/system/model.h"

namespace rotorub {

class Command {
 public:
  // The model must outlive the command.
  explicit Command(const Model& model) : model_(&model) {}

  // What the actuator is told (system/actuation.h) over the step that starts at t (s); ask once a
  // step, in order.
  // 0 before the controller is on and without one.
  const Eigen::Vector2d& at(double t, const double* q, const double* v);

  // All that it remembers, as plain numbers.
  static constexpr std::size_t kMemory = 3;
  void save(double* to) const;
  void restore(const double* from);

 private:
  const Model* model_;
  Eigen::Vector2d held_{0.0, 0.0};
  double last_sample_ = -1.0;  // index of the sample held; -1: none yet
};

}  // namespace rotorub
