// One point of a branch of periodic motions (continuation.h) and the step to the next one.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <memory>
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
  double length() const { return std::sqrt(dot(*this)); }
  Tangent scaled(double by) const { return {by * state, by * period, by * parameter}; }
};

// The equations of Newton's method at a point, without the last one.
struct BranchEquations {
  ReturnDerivative d;
  Eigen::MatrixXd matrix;  // columns: tangent space, ln T (autonomous), p; the last row is empty
  Eigen::VectorXd sizes;   // of all entries, in which d and the matrix are expressed
  Eigen::MatrixXd basis;   // B in the sizes of the branch
};

struct CorrectedPoint {
  BranchPoint point;
  Tangent tangent;     // of length 1
  std::string events;  // letters of the events of one period, an accumulation counts as one
  std::shared_ptr<const BranchEquations> equations;  // at the point
};

class BranchCorrector {
 public:
  // All must outlive this object. start: found at `parameter`.
  BranchCorrector(const std::function<Model(double)>& model_at, double parameter,
                  const PeriodicMotion& start, const ContinuationParameters& parameters);

  // The start as a point, with the tangent that leads to larger (direction > 0) or smaller p.
  std::optional<CorrectedPoint> first(double direction) const;
  // The point at the arclength `step` from another; empty if Newton's method does not converge
  // within the range of the parameter.
  std::optional<CorrectedPoint> next(const CorrectedPoint& from, double step) const;
  // The point at the arclength `step` in another direction, in the plane normal to the part of the
  // direction that is normal to the tangent at `from`.
  std::optional<CorrectedPoint> beside(const CorrectedPoint& from, const Tangent& direction,
                                       double step) const;
  const Eigen::VectorXd& sizes() const { return sizes_; }  // of the essential entries
  // The parameter at the arclength `step` along the tangent is in its range.
  bool stays_in_range(const CorrectedPoint& from, double step) const;
  // True if the motion there has other events.
  bool events_change(const CorrectedPoint& from, double step) const;

 private:
  std::shared_ptr<const BranchEquations> equations_at(const BranchPoint& at, const Return& point,
                                                      const ReturnMap& map) const;
  void place(const Model& model, BranchPoint& at) const;
  ReturnMap map_of(const Model& model) const;
  BranchPoint predicted(const BranchPoint& from, const Tangent& along, double step) const;
  bool is_in_range(double parameter) const;
  // near: equations of a point nearby, which serve while they make the residual fall fast; or null.
  std::optional<CorrectedPoint> correct(BranchPoint at, const Tangent& along,
                                        std::shared_ptr<const BranchEquations> near) const;
  Eigen::RowVectorXd row_of(const BranchEquations& equations, const Tangent& along) const;
  Tangent tangent_of(const BranchEquations& equations, const Eigen::VectorXd& solution) const;
  Eigen::VectorXd essential(const State& state) const;

  const std::function<Model(double)>* model_at_;
  const ContinuationParameters* parameters_;
  Model model_;  // at the start
  EssentialState entries_;
  Eigen::VectorXd sizes_;  // of the essential entries
  BranchPoint start_;
  bool autonomous_ = false, turning_ = false;
  int periods_ = 1;     // n of the loads in one period
  double phase_ = 0.0;  // time of the start in periods, under loads
};

}  // namespace rotorub::periodic
