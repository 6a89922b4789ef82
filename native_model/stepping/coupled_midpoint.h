// One step of `midpoint` with several contacts: the scheme of midpoint_step.h. Impacts are not
// located: all contacts that close in a step and all that last take part in one impact at its
// middle.
#pragma once

#include "native_model/stepping/coupled_step.h"

namespace rotorub {

class CoupledMidpoint : public CoupledStep {
 public:
  // From the model's initial state. The model must outlive it. step: s, > 0.
  CoupledMidpoint(const Model& model, double step);

  FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) override;

 private:
  bool rebounds(const Contact& c, double approach, double pressed) const override;
  void back_to_circles();
  void collide(double t);
  void close_gaps(const Blow& blow, double t);

  Columns acceleration_, load_;
};

}  // namespace rotorub
