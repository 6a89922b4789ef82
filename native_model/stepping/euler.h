// The time stepping exactly as in the paper, as a baseline: (10) an explicit Euler step for the
// velocities; (11) q+ = q + h v+; (12)-(13) contact with the gap of q+ and the slip of v+,
// linearised about q; and Poisson's law (15)-(19) if a contact closes. All loads, including
// damping, are explicit. The order is 1.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "native_model/contact/coupled_law.h"
#include "native_model/model/model.h"
#include "native_model/stepping/stepper.h"

namespace rotorub {

class EulerStepper : public FixedStepper {
 public:
  // Starts at the model's initial state. step: s, > 0. The model must outlive the stepper.
  EulerStepper(const Model& model, double step);

  FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) override;
  const double* q() const override { return state_.q.data(); }
  const double* v() const override { return state_.v.data(); }

 private:
  // A contact whose gap would become negative in the step without contact forces. If there are
  // several contacts, those that last count too.
  struct Closing {
    std::size_t index = 0;
    Eigen::Vector2d e_r{1.0, 0.0};
    bool impact = false;                  // rebounds long enough (contact/impact.h)
    double gap_rate = 0.0, slip = 0.0;    // m/s, without contact
    double before = 0.0;                  // m/s, slip before the step
    double end = 0.0;                     // m/s, gap at the end of the step over h
    double normal = 0.0, friction = 0.0;  // N s
    bool sticks = false;
  };
  Status touch(double t, const Eigen::VectorXd& start);
  Status solve_one(double t, Closing& c) const;
  Status solve_all(double t, std::span<Closing> closing) const;

  const Model* model_;
  double h_;
  State state_;
  Eigen::VectorXd free_, f_;
  std::array<bool, kMaxContacts> in_contact_{};
  // Results of the last step.
  std::vector<ContactStep> done_;
  std::vector<Impact> hits_;
};

}  // namespace rotorub
