// One point of a branch of periodic motions (continuation.h) and the step to the next one.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

#include "native_model/periodic/continuation.h"

namespace rotorub::periodic {

// A direction in (x, ln T, p): x in the essential entries divided by the sizes of the branch, p by
// the scale of the parameter.
struct Tangent {
  Eigen::VectorXd state;
  double period = 0.0, parameter = 0.0;
  double dot(const Tangent& other) const {
    return state.dot(other.state) + period * other.period + parameter * other.parameter;
  }
};

struct CorrectedPoint {
  BranchPoint point;
  Tangent tangent;     // of length 1
  std::string events;  // letters of the events of one period, an accumulation counts as one
};

class BranchCorrector {
 public:
  // All must outlive this object. start: found at `parameter`.
  BranchCorrector(const std::function<Model(double)>& model_at, double parameter,
                  const PeriodicMotion& start, const ContinuationParameters& parameters);

  // The start as a point, with the tangent that leads in the direction of the parameters.
  std::optional<CorrectedPoint> first() const;
  // The point at the arclength `step` from another; empty if Newton's method does not converge.
  std::optional<CorrectedPoint> next(const CorrectedPoint& from, double step) const;

 private:
  struct Linear;
  Linear linear_at(const BranchPoint& at, const Return& point, const ReturnMap& map) const;
  void place(const Model& model, BranchPoint& at) const;
  std::optional<CorrectedPoint> correct(BranchPoint at, const Tangent& along,
                                        const BranchPoint& predicted) const;
  Eigen::VectorXd essential(const State& state) const;

  const std::function<Model(double)>* model_at_;
  const ContinuationParameters* parameters_;
  Model model_;  // at the start
  EssentialState entries_;
  Eigen::VectorXd sizes_;  // of the essential entries
  BranchPoint start_;
  bool autonomous_ = false;
  int periods_ = 1;     // n of the loads in one period
  double phase_ = 0.0;  // time of the start in periods, under loads
};

}  // namespace rotorub::periodic
