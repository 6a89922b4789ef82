// The time stepping of the paper to the letter, as a baseline: (10) an explicit Euler step of the
// velocities, (11) q+ = q + h v+, (12)-(13) contact with the gap of q+ and the slip of v+
// linearised about q, Poisson's law (15)-(19) where a contact closes. All loads, damping included,
// are explicit. First order. `midpoint` (midpoint_step.h) is its better relative.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "native_model/stepping/fixed_step.h"
#include "native_model/system/model.h"

namespace rotorub {

class EulerStepper {
 public:
  // As MidpointStepper.
  EulerStepper(const Model& model, double step)
      : model_(&model), h_(step), state_(initial_state(model)), free_(model.nq()), f_(model.nq()) {}

  FixedStep step(std::int64_t k, const Eigen::Vector2d& u, bool works);
  const double* q() const { return state_.q.data(); }
  const double* v() const { return state_.v.data(); }

 private:
  void touch(double t, FixedStep& out);
  void record(double t, const Eigen::Vector2d& e_r, FixedStep& out);
  // v += M^-1 J^T of the impulses.
  void push(double t, const Eigen::Vector2d& e_r, double normal, double friction);

  const Model* model_;
  double h_;
  State state_;
  Eigen::VectorXd free_, f_;
  Impact hit_;  // of the last step
  bool in_contact_ = false;
};

}  // namespace rotorub
