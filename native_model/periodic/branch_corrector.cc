#include "native_model/periodic/branch_corrector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/numerics/linear_solve.h"

namespace rotorub::periodic {
namespace {

constexpr int kMostCorrections = 12;
constexpr double kOfScale = 1e-5;              // of the parameter's scale, for differences
constexpr double kMostResidual = 0.5;          // a correction that exceeds it has lost the branch
constexpr std::size_t kLeastAccumulation = 6;  // impacts

std::string events_of(const MotionRecord& motion) {
  std::string events;
  std::size_t impacts = 0;
  for (const Stretch& s : motion.stretches) {
    if (!s.jump) continue;
    const auto digit = static_cast<char>('1' + s.jump->contact);
    const Mode from = s.states[s.jump->contact].mode, to = s.jump->states[s.jump->contact].mode;
    impacts = from == Mode::kFree ? impacts + 1 : 0;
    if (from == Mode::kFree) events += {digit, 'i'};
    if (to == from) continue;
    // The number of impacts in an accumulation is no property of the motion.
    if (impacts >= kLeastAccumulation) {
      events.resize(events.size() - 2 * impacts);
      events += {digit, 'a'};
    }
    impacts = 0;
    events += {digit, to == Mode::kFree ? 'f' : to == Mode::kSlide ? 's' : 'r'};
  }
  return events;
}

}  // namespace

// The equations of Newton's method at a point, without the last one.
struct BranchCorrector::Linear {
  ReturnDerivative d;
  Eigen::MatrixXd matrix;  // columns: tangent space, ln T (autonomous), p; the last row is empty
  Eigen::VectorXd right;
  Eigen::MatrixXd basis;  // B in the sizes of the branch

  Eigen::RowVectorXd row(const Tangent& along, bool autonomous) const {
    Eigen::RowVectorXd last(matrix.cols());
    last.head(basis.cols()) = along.state.transpose() * basis;
    if (autonomous) last[basis.cols()] = along.period;
    last[matrix.cols() - 1] = along.parameter;
    return last;
  }
  Tangent tangent(const Eigen::VectorXd& solution, bool autonomous) const {
    Tangent t{basis * solution.head(basis.cols()), autonomous ? solution[basis.cols()] : 0.0,
              solution[solution.size() - 1]};
    const double length = std::sqrt(t.dot(t));
    t.state /= length;
    t.period /= length;
    t.parameter /= length;
    return t;
  }
};

BranchCorrector::BranchCorrector(const std::function<Model(double)>& model_at, double parameter,
                                 const PeriodicMotion& start,
                                 const ContinuationParameters& parameters)
    : model_at_(&model_at),
      parameters_(&parameters),
      model_(model_at(parameter)),
      entries_(model_),
      start_{PointKind::kRegular, parameter, start} {
  const ReturnMap map(model_, parameters.search.event);
  const double period = map.forcing().period;
  autonomous_ = period == 0.0;
  if (!autonomous_) {
    periods_ = static_cast<int>(std::lround(start.period / period));
    phase_ = start.start.t / period;
  }
  sizes_ = entries_.take(map.at(start.start, start.period, start.turns).sizes.data());
}

Eigen::VectorXd BranchCorrector::essential(const State& state) const {
  Eigen::VectorXd y(2 * state.q.size());
  y << state.q, state.v;
  return entries_.take(y.data());
}

// Sets what follows from the parameter: the period of the loads, and the time of the start at the
// same phase of the loads; and puts the state onto the constraints.
void BranchCorrector::place(const Model& model, BranchPoint& at) const {
  const Forcing forcing = forcing_of(model);
  if (!autonomous_) {
    at.motion.period = periods_ * forcing.period;
    at.motion.start.t = phase_ * forcing.period;
  }
  ReturnMap(model).project(at.motion.start, at.motion.held);
}

BranchCorrector::Linear BranchCorrector::linear_at(const BranchPoint& at, const Return& point,
                                                   const ReturnMap& map) const {
  Linear l;
  l.d = map.derivative(point, at.motion.held);
  const Eigen::VectorXd own = entries_.take(point.sizes.data());
  const Eigen::Index k = l.d.basis.cols(), n = k + (autonomous_ ? 2 : 1);
  l.basis = own.cwiseQuotient(sizes_).asDiagonal() * l.d.basis;
  l.matrix = Eigen::MatrixXd::Zero(n, n);
  l.right = Eigen::VectorXd::Zero(n);
  const Eigen::MatrixXd project = l.d.basis.transpose();
  l.matrix.topLeftCorner(k, k) = project * (l.d.image - l.d.basis);
  l.right.head(k) = -(project * point.change);
  if (autonomous_) {
    l.matrix.block(0, k, k, 1) = at.motion.period * (project * l.d.end_slope);
    l.matrix.block(k, 0, 1, k) = at.motion.period * (l.d.start_slope.transpose() * l.d.basis);
  }
  const auto change_at = [&](double share) -> Eigen::VectorXd {
    BranchPoint beside = at;
    beside.parameter += share * parameters_->scale;
    const Model model = (*model_at_)(beside.parameter);
    place(model, beside);
    const ReturnMap there(model, parameters_->search.event);
    const Return to = there.at(beside.motion.start, beside.motion.period, beside.motion.turns);
    if (to.status != Status::kOk) return Eigen::VectorXd::Constant(own.size(), kInfinity);
    return to.change.cwiseProduct(entries_.take(to.sizes.data())).cwiseQuotient(own);
  };
  l.matrix.block(0, n - 1, k, 1) =
      project * (change_at(kOfScale) - change_at(-kOfScale)) / (2.0 * kOfScale);
  return l;
}

std::optional<CorrectedPoint> BranchCorrector::correct(BranchPoint at, const Tangent& along,
                                                       const BranchPoint& predicted) const {
  const Eigen::VectorXd from = essential(predicted.motion.start).cwiseQuotient(sizes_);
  for (int i = 0; i <= kMostCorrections; ++i) {
    const Model model = (*model_at_)(at.parameter);
    place(model, at);
    const ReturnMap map(model, parameters_->search.event);
    const Return point = map.at(at.motion.start, at.motion.period, at.motion.turns);
    if (!(point.residual < kMostResidual)) return {};
    Linear l = linear_at(at, point, map);
    if (!l.matrix.allFinite()) return {};
    const Eigen::Index last = l.matrix.rows() - 1;
    l.matrix.row(last) = l.row(along, autonomous_);
    if (point.residual <= parameters_->search.tolerance) {
      l.right.setZero();
      l.right[last] = 1.0;
      CorrectedPoint found;
      found.tangent = l.tangent(least_squares(l.matrix, l.right), autonomous_);
      if (found.tangent.dot(along) < 0.0) return {};
      at.motion.status = SearchStatus::kFound;
      at.motion.residual = point.residual;
      at.motion.iterations = i;
      at.motion.multipliers = floquet_multipliers(l.d, autonomous_);
      at.motion.stable = is_stable(at.motion.multipliers);
      found.events = events_of(point.motion);
      found.point = std::move(at);
      return found;
    }
    if (l.d.grazes) return {};
    const Eigen::VectorXd here = essential(at.motion.start).cwiseQuotient(sizes_);
    l.right[last] = -(along.state.dot(here - from) +
                      along.period * std::log(at.motion.period / predicted.motion.period) +
                      along.parameter * (at.parameter - predicted.parameter) / parameters_->scale);
    const Eigen::VectorXd step = least_squares(l.matrix, l.right);
    if (!step.allFinite() || step.cwiseAbs().maxCoeff() > 1.0) return {};
    const Eigen::Index k = l.d.basis.cols();
    at.motion.start = map.moved(at.motion.start, point, l.d.basis, step.head(k), {});
    if (autonomous_) at.motion.period *= std::exp(step[k]);
    at.parameter += parameters_->scale * step[last];
  }
  return {};
}

std::optional<CorrectedPoint> BranchCorrector::first() const {
  const Tangent along{Eigen::VectorXd::Zero(sizes_.size()), 0.0,
                      parameters_->direction < 0.0 ? -1.0 : 1.0};
  return correct(start_, along, start_);
}

std::optional<CorrectedPoint> BranchCorrector::next(const CorrectedPoint& from, double step) const {
  BranchPoint predicted = from.point;
  const Tangent& t = from.tangent;
  State& start = predicted.motion.start;
  const int nq = model_.nq();
  for (Eigen::Index i = 0; i < sizes_.size(); ++i) {
    const int entry = entries_.entries()[static_cast<std::size_t>(i)];
    (entry < nq ? start.q[entry] : start.v[entry - nq]) += step * sizes_[i] * t.state[i];
  }
  if (autonomous_) predicted.motion.period *= std::exp(step * t.period);
  predicted.parameter += step * parameters_->scale * t.parameter;
  return correct(predicted, t, predicted);
}

}  // namespace rotorub::periodic
