#include "native_model/periodic/return_map.h"

#include <limits>
#include <numbers>

#include "native_model/numerics/linear_solve.h"
#include "native_model/periodic/contact_gradients.h"

namespace rotorub::periodic {

ReturnMap::ReturnMap(const Model& model, const EventParameters& parameters, bool turning)
    : model_(&model),
      parameters_(parameters),
      forcing_(forcing_of(model)),
      essential_(model),
      frame_(turning ? TurningFrame(model) : TurningFrame()) {}

Eigen::VectorXd ReturnMap::scaled(const Eigen::VectorXd& y, const Eigen::VectorXd& sizes) const {
  return essential_.take(y.cwiseQuotient(sizes).eval().data());
}

Return ReturnMap::at(const State& start, double period, int turns) const {
  Return to;
  to.residual = std::numeric_limits<double>::infinity();
  if (start.q.size() != model_->nq()) {
    to.status = Status::kNoSolution;
    to.message = "the controllers remember a different number of values here";
    return to;
  }
  to.motion = record_motion(*model_, start, start.t + period, parameters_);
  to.status = to.motion.status;
  to.message = to.motion.message;
  try {
    to.sizes = sizes_along(*model_, to.motion);
  } catch (const ControllerError& error) {  // the law fails close to the motion
    to.status = Status::kControllerFailed;
    to.message = error.what();
  }
  if (to.status != Status::kOk) return to;
  to.change =
      scaled(frame_.seen(as_vector(to.motion.end), period) - as_vector(to.motion.start), to.sizes);
  if (const int at = essential_.spin_angle(); at != kAbsent) {
    to.change[at] -= 2.0 * std::numbers::pi * turns;
  }
  if (to.change.allFinite()) to.residual = to.change.cwiseAbs().maxCoeff();
  return to;
}

ReturnDerivative ReturnMap::derivative(const Return& point, const HeldContacts& held) const {
  ReturnDerivative d;
  const Eigen::Index n = essential_.size();
  d.basis = Eigen::MatrixXd::Identity(n, n);
  if (!held.empty()) {
    const Eigen::MatrixXd rows = constraint_gradients(*model_, point.motion.start, held);
    Eigen::MatrixXd directions(n, rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const Eigen::VectorXd scaled_row = rows.row(i).transpose().cwiseProduct(point.sizes);
      directions.col(i) = essential_.take(scaled_row.data());
      directions.col(i).normalize();
    }
    d.basis = orthogonal_complement(directions);
  }
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(point.sizes.size(), d.basis.cols());
  for (Eigen::Index i = 0; i < n; ++i) {
    const int at = essential_.entries()[static_cast<std::size_t>(i)];
    w.row(at) = point.sizes[at] * d.basis.row(i);
  }
  FlowDerivative flow(*model_, point.sizes, parameters_);
  try {
    w = flow.along(point.motion, w);
    d.grazes = flow.grazes();
  } catch (const ControllerError&) {  // the law fails close to the motion: no derivative
    w.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  d.image.resize(n, w.cols());
  const MotionRecord& m = point.motion;
  const double period = m.end_time - m.begin_time;
  for (Eigen::Index j = 0; j < w.cols(); ++j)
    d.image.col(j) = scaled(frame_.seen(w.col(j), period), point.sizes);
  zero_rows_of_settings(d);
  const auto slope = [&](const std::vector<double>& y, const Eigen::VectorXd& rates, double after) {
    return scaled(frame_.slope_seen(frame_.seen(as_vector(y), after), frame_.seen(rates, after)),
                  point.sizes);
  };
  d.start_slope = slope(m.start, flow.slope(m.begin_time, m.start, m.first), 0.0);
  d.end_slope = slope(m.end, flow.slope(m.end_time, m.end, m.last), period);
  return d;
}

// Entries in the memory of a controller that no sample changes are settings, not states. The row of
// P' is that of the identity for them, which makes P' - 1 singular; 0 means that they stay.
void ReturnMap::zero_rows_of_settings(ReturnDerivative& d) const {
  constexpr double kSame = 1e-9;
  for (Eigen::Index i = 0; i < d.image.rows(); ++i) {
    const int at = essential_.entries()[static_cast<std::size_t>(i)];
    if (at < model_->nq() + model_->layout.control_state()) continue;
    if ((d.image.row(i) - d.basis.row(i)).cwiseAbs().maxCoeff() < kSame) d.image.row(i).setZero();
  }
}

State ReturnMap::moved(const State& from, const Eigen::VectorXd& sizes,
                       const Eigen::MatrixXd& basis, const Eigen::VectorXd& c,
                       const HeldContacts& held) const {
  const int nq = model_->nq();
  const Eigen::VectorXd step = basis * c;
  State to = from;
  for (Eigen::Index i = 0; i < step.size(); ++i) {
    const int at = essential_.entries()[static_cast<std::size_t>(i)];
    double& entry = at < nq ? to.q[at] : to.v[at - nq];
    entry += sizes[at] * step[i];
  }
  project(to, held);
  return to;
}

void ReturnMap::project(State& state, const HeldContacts& held) const {
  if (held.empty()) return;
  Constraint constraint(*model_);
  constraint.project(state.t, state.q.data(), state.v.data(), held);
}

}  // namespace rotorub::periodic
