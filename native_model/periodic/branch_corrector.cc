#include "native_model/periodic/branch_corrector.h"

#include <algorithm>
#include <cmath>

#include "native_model/numerics/linear_solve.h"

namespace rotorub::periodic {
namespace {

constexpr int kMostCorrections = 20;
constexpr double kOfScale = 1e-5;  // of the parameter's scale, for differences
constexpr double kFastFall = 0.1;  // of the residual in one iteration with equations from nearby
constexpr double kMostResidual = 0.5;          // a correction that exceeds it has lost the branch
constexpr std::size_t kLeastAccumulation = 6;  // impacts

std::string events_of(const MotionRecord& motion) {
  std::string events;
  std::size_t impacts = 0;
  for (const Stretch& s : motion.stretches) {
    if (!s.jump) continue;
    const auto digit = static_cast<char>('1' + s.jump->contact);
    const ContactMode from = s.states[s.jump->contact].mode,
                      to = s.jump->states[s.jump->contact].mode;
    impacts = from == ContactMode::kFree ? impacts + 1 : 0;
    if (from == ContactMode::kFree) events += {digit, 'i'};
    if (to == from) continue;
    // The number of impacts in an accumulation is not a property of the motion.
    if (impacts >= kLeastAccumulation) {
      events.resize(events.size() - 2 * impacts);
      events += {digit, 'a'};
    }
    impacts = 0;
    events += {digit, to == ContactMode::kFree ? 'f' : to == ContactMode::kSlide ? 's' : 'r'};
  }
  return events;
}

}  // namespace

Eigen::RowVectorXd BranchCorrector::row_of(const BranchEquations& equations,
                                           const Tangent& along) const {
  const Eigen::MatrixXd& basis = equations.basis;
  Eigen::RowVectorXd last(equations.matrix.cols());
  last.head(basis.cols()) = along.state.transpose() * basis;
  if (autonomous_) last[basis.cols()] = along.period;
  last[last.size() - 1] = along.parameter;
  return last;
}

Tangent BranchCorrector::tangent_of(const BranchEquations& equations,
                                    const Eigen::VectorXd& solution) const {
  const Eigen::MatrixXd& basis = equations.basis;
  const Tangent t{basis * solution.head(basis.cols()), autonomous_ ? solution[basis.cols()] : 0.0,
                  solution[solution.size() - 1]};
  return t.scaled(1.0 / t.length());
}

BranchCorrector::BranchCorrector(const std::function<Model(double)>& model_at, double parameter,
                                 const PeriodicMotion& start,
                                 const ContinuationParameters& parameters)
    : model_at_(&model_at),
      parameters_(&parameters),
      model_(model_at(parameter)),
      entries_(model_),
      start_{PointKind::kRegular, parameter, start} {
  turning_ = start.frame != 0.0;
  const ReturnMap map = map_of(model_);
  const double period = map.forcing().period;
  autonomous_ = map.is_autonomous();
  if (!autonomous_) periods_ = static_cast<int>(std::lround(start.period / period));
  if (period > 0.0) phase_ = start.start.t / period;
  sizes_ = entries_.take(map.at(start.start, start.period, start.turns).sizes.data());
}

ReturnMap BranchCorrector::map_of(const Model& model) const {
  return ReturnMap(model, parameters_->search.event, turning_);
}

Eigen::VectorXd BranchCorrector::essential(const State& state) const {
  Eigen::VectorXd y(2 * state.q.size());
  y << state.q, state.v;
  return entries_.take(y.data());
}

// Sets what follows from the parameter: the period of the loads, and the time of the start at the
// same phase of the loads, after the last load is switched; and puts the state onto the
// constraints.
void BranchCorrector::place(const Model& model, BranchPoint& at) const {
  const Forcing forcing = forcing_of(model);
  if (!autonomous_) at.motion.period = periods_ * forcing.period;
  if (forcing.period > 0.0) {
    // Not earlier than the first motion, whose ramps and triggers have passed.
    const double from = std::max(forcing.settled, start_.motion.start.t);
    const double early = from / forcing.period - phase_;
    at.motion.start.t = (phase_ + std::max(0.0, std::ceil(early))) * forcing.period;
  }
  ReturnMap(model).project(at.motion.start, at.motion.held);
}

std::shared_ptr<const BranchEquations> BranchCorrector::equations_at(const BranchPoint& at,
                                                                     const Return& point,
                                                                     const ReturnMap& map) const {
  auto made = std::make_shared<BranchEquations>();
  BranchEquations& e = *made;
  e.d = map.derivative(point, at.motion.held);
  e.sizes = point.sizes;
  const Eigen::VectorXd own = entries_.take(point.sizes.data());
  const Eigen::Index k = e.d.basis.cols(), n = k + (autonomous_ ? 2 : 1);
  e.basis = own.cwiseQuotient(sizes_).asDiagonal() * e.d.basis;
  e.matrix = Eigen::MatrixXd::Zero(n, n);
  const Eigen::MatrixXd project = e.d.basis.transpose();
  e.matrix.topLeftCorner(k, k) = project * (e.d.image - e.d.basis);
  if (autonomous_) {
    e.matrix.block(0, k, k, 1) = at.motion.period * (project * e.d.end_slope);
    e.matrix.block(k, 0, 1, k) = at.motion.period * (e.d.start_slope.transpose() * e.d.basis);
  }
  const auto change_at = [&](double share) -> Eigen::VectorXd {
    BranchPoint beside = at;
    beside.parameter += share * parameters_->scale;
    const Model model = (*model_at_)(beside.parameter);
    place(model, beside);
    const Return to =
        map_of(model).at(beside.motion.start, beside.motion.period, beside.motion.turns);
    if (to.status != Status::kOk) return Eigen::VectorXd::Constant(own.size(), kInfinity);
    return to.change.cwiseProduct(entries_.take(to.sizes.data())).cwiseQuotient(own);
  };
  const ContinuationParameters& p = *parameters_;
  const double low = std::max(-kOfScale, (p.lowest - at.parameter) / p.scale),
               high = std::min(kOfScale, (p.highest - at.parameter) / p.scale);
  e.matrix.block(0, n - 1, k, 1) = project * (change_at(high) - change_at(low)) / (high - low);
  return made;
}

std::optional<CorrectedPoint> BranchCorrector::correct(
    BranchPoint at, const Tangent& along, std::shared_ptr<const BranchEquations> near) const {
  const Eigen::VectorXd from = essential(at.motion.start).cwiseQuotient(sizes_);
  const double begun_period = at.motion.period, begun_parameter = at.parameter;
  double before = kInfinity;  // residual of the last iteration
  bool fresh = false;         // `near` belonged to its point
  for (int i = 0; i <= kMostCorrections; ++i) {
    if (!is_in_range(at.parameter)) return {};
    const Model model = (*model_at_)(at.parameter);
    place(model, at);
    const ReturnMap map = map_of(model);
    const Return point = map.at(at.motion.start, at.motion.period, at.motion.turns);
    if (!(point.residual < kMostResidual) || (fresh && point.residual > before)) return {};
    const bool found = point.residual <= parameters_->search.tolerance;
    fresh = found || !near || point.residual > kFastFall * before;
    before = point.residual;
    if (fresh) near = equations_at(at, point, map);
    if (!near->matrix.allFinite()) return {};
    const Eigen::Index k = near->d.basis.cols(), last = near->matrix.rows() - 1;
    Eigen::MatrixXd matrix = near->matrix;
    matrix.row(last) = row_of(*near, along);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(last + 1);
    if (found) {
      right[last] = 1.0;
      CorrectedPoint corrected;
      corrected.tangent = tangent_of(*near, least_squares(matrix, right));
      if (corrected.tangent.dot(along) < 0.0) return {};
      at.motion.status = SearchStatus::kFound;
      at.motion.residual = point.residual;
      at.motion.iterations = i;
      at.motion.multipliers = floquet_multipliers(near->d, autonomous_);
      at.motion.stable = is_stable(at.motion.multipliers);
      corrected.events = events_of(point.motion);
      corrected.point = std::move(at);
      corrected.equations = std::move(near);
      return corrected;
    }
    if (near->d.grazes) return {};
    const Eigen::VectorXd change = point.change.cwiseProduct(entries_.take(point.sizes.data()))
                                       .cwiseQuotient(entries_.take(near->sizes.data()));
    right.head(k) = -(near->d.basis.transpose() * change);
    const Eigen::VectorXd here = essential(at.motion.start).cwiseQuotient(sizes_);
    right[last] =
        -(along.state.dot(here - from) + along.period * std::log(at.motion.period / begun_period) +
          along.parameter * (at.parameter - begun_parameter) / parameters_->scale);
    const Eigen::VectorXd step = least_squares(matrix, right);
    if (!step.allFinite() || step.cwiseAbs().maxCoeff() > 1.0) return {};
    at.motion.start = map.moved(at.motion.start, near->sizes, near->d.basis, step.head(k), {});
    if (autonomous_) at.motion.period *= std::exp(step[k]);
    at.parameter += parameters_->scale * step[last];
  }
  return {};
}

std::optional<CorrectedPoint> BranchCorrector::first(double direction) const {
  const Tangent along{Eigen::VectorXd::Zero(sizes_.size()), 0.0, direction < 0.0 ? -1.0 : 1.0};
  return correct(start_, along, nullptr);
}

BranchPoint BranchCorrector::predicted(const BranchPoint& from, const Tangent& t,
                                       double step) const {
  BranchPoint to = from;
  State& start = to.motion.start;
  const int nq = model_.nq();
  for (Eigen::Index i = 0; i < sizes_.size(); ++i) {
    const int entry = entries_.entries()[static_cast<std::size_t>(i)];
    (entry < nq ? start.q[entry] : start.v[entry - nq]) += step * sizes_[i] * t.state[i];
  }
  if (autonomous_) to.motion.period *= std::exp(step * t.period);
  to.parameter += step * parameters_->scale * t.parameter;
  to.kind = PointKind::kRegular;
  return to;
}

std::optional<CorrectedPoint> BranchCorrector::next(const CorrectedPoint& from, double step) const {
  return correct(predicted(from.point, from.tangent, step), from.tangent, from.equations);
}

std::optional<CorrectedPoint> BranchCorrector::beside(const CorrectedPoint& from,
                                                      const Tangent& direction, double step) const {
  const Tangent& t = from.tangent;
  const double share = direction.dot(t) / t.dot(t);
  const Tangent normal{direction.state - share * t.state, direction.period - share * t.period,
                       direction.parameter - share * t.parameter};
  if (!(normal.length() > 0.0)) return {};
  return correct(predicted(from.point, direction, step), normal.scaled(1.0 / normal.length()),
                 nullptr);
}

bool BranchCorrector::is_in_range(double parameter) const {
  return parameter >= parameters_->lowest && parameter <= parameters_->highest;
}

bool BranchCorrector::stays_in_range(const CorrectedPoint& from, double step) const {
  return is_in_range(predicted(from.point, from.tangent, step).parameter);
}

bool BranchCorrector::events_change(const CorrectedPoint& from, double step) const {
  BranchPoint to = predicted(from.point, from.tangent, step);
  const Model model = (*model_at_)(to.parameter);
  place(model, to);
  const Return point = map_of(model).at(to.motion.start, to.motion.period, to.motion.turns);
  return point.status != Status::kOk || events_of(point.motion) != from.events;
}

}  // namespace rotorub::periodic
