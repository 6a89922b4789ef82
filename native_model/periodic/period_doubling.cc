#include "native_model/periodic/period_doubling.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "native_model/numerics/eigenvalues.h"

namespace rotorub::periodic {
namespace {

constexpr double kFlips = 1e-4;  // largest distance of a multiplier from -1
// The first step along the eigenvector is halved at most this many times.
constexpr int kMostHalvings = 5;
// A motion differs at least by this share of its step from itself half a period later.
constexpr double kDiffers = 1e-3;
// Largest cosine between the differences on both sides of a motion of half the period.
constexpr double kOpposite = -0.5;
// The same if one of them is a motion of half the period.
constexpr double kSameMotion = 1e-6;
constexpr double kSamePeriods = 1e-6;  // relative
constexpr int kMostSecants = 8;
constexpr double kOnFlip = 1e-9;  // of 1 + the multiplier

// The real multiplier nearest to -1, plus 1; empty without multipliers.
std::optional<double> off_flip(const PeriodicMotion& motion) {
  if (motion.multipliers.empty()) return {};
  const auto off = [](const std::complex<double>& m) { return std::abs(m + 1.0); };
  return std::ranges::min(motion.multipliers, {}, off).real() + 1.0;
}

// The motion over two of its periods.
PeriodicMotion twice(PeriodicMotion motion) {
  motion.period *= 2.0;
  motion.turns *= 2;
  for (std::complex<double>& m : motion.multipliers) m *= m;
  motion.stable = is_stable(motion.multipliers);
  return motion;
}

// The eigenvector of the multiplier nearest to -1, in the sizes of the branch; empty if there is
// none.
std::optional<Eigen::VectorXd> flip_direction(const BranchEquations& equations) {
  const Eigen::MatrixXd map = equations.d.basis.transpose() * equations.d.image;
  const auto modes = real_modes(map);
  if (!modes) return {};
  Eigen::Index at = 0;
  if (!((modes->values.array() + 1.0).abs().minCoeff(&at) < kFlips)) return {};
  const Eigen::VectorXd v = equations.basis * modes->vectors.col(at).real();
  return v / v.norm();
}

// The change of the state in half the period, scaled. Empty if the loads do not repeat in this
// time.
std::optional<Eigen::VectorXd> half_change(const Model& model, const PeriodicMotion& motion,
                                           const SearchParameters& search) {
  const ReturnMap map(model, search.event, motion.frame != 0.0);
  if (motion.turns % 2 != 0) return {};
  const double half = 0.5 * motion.period, of_loads = map.forcing().period;
  if (!map.is_autonomous() &&
      std::abs(half / of_loads - std::round(half / of_loads)) > kSamePeriods) {
    return {};
  }
  const Return back = map.at(motion.start, half, motion.turns / 2);
  if (back.status != Status::kOk) return {};
  return back.change;
}

}  // namespace

bool flips(const PeriodicMotion& motion) {
  return std::ranges::any_of(motion.multipliers,
                             [](const auto& m) { return std::abs(m + 1.0) < kFlips; });
}

std::optional<DoubledBranch> doubled_branch(const std::function<Model(double)>& model_at,
                                            const BranchPoint& doubling,
                                            const ContinuationParameters& parameters) {
  const double parameter = doubling.parameter;
  const BranchCorrector once(model_at, parameter, doubling.motion, parameters);
  const auto at = once.first(parameters.direction);
  if (!at) return {};
  const auto direction = flip_direction(*at->equations);
  if (!direction) return {};
  DoubledBranch found;
  found.begin = {PointKind::kPeriodDoubling, parameter, twice(at->point.motion)};
  found.corrector =
      std::make_unique<BranchCorrector>(model_at, parameter, found.begin.motion, parameters);
  // The sizes of the state over one and over two periods differ slightly.
  const Eigen::VectorXd sizes = once.sizes().cwiseQuotient(found.corrector->sizes());
  CorrectedPoint from = *at;
  from.point = found.begin;
  from.tangent.state = from.tangent.state.cwiseProduct(sizes);
  from.equations = nullptr;
  const Tangent along{direction->cwiseProduct(sizes), 0.0, 0.0};
  double step = parameters.first_step;
  for (int k = 0; k <= kMostHalvings; ++k, step *= 0.5) {
    auto beside = found.corrector->beside(from, along, step);
    if (!beside) continue;
    const auto change =
        half_change(model_at(beside->point.parameter), beside->point.motion, parameters.search);
    if (!change || !(change->cwiseAbs().maxCoeff() > kDiffers * step)) continue;
    found.first = std::move(*beside);
    return found;
  }
  return {};
}

bool has_half_period_between(const std::function<Model(double)>& model_at,
                             const ContinuationParameters& parameters, const CorrectedPoint& from,
                             const CorrectedPoint& to) {
  const auto change_at = [&](const CorrectedPoint& at) {
    return half_change(model_at(at.point.parameter), at.point.motion, parameters.search);
  };
  const auto before = change_at(from);
  if (!before) return false;
  const auto after = change_at(to);
  if (!after) return false;
  return after->norm() <= kSameMotion * before->norm() ||
         before->dot(*after) < kOpposite * before->norm() * after->norm();
}

std::optional<BranchPoint> half_period_between(const std::function<Model(double)>& model_at,
                                               const ContinuationParameters& parameters,
                                               const CorrectedPoint& from,
                                               const CorrectedPoint& to) {
  const PeriodicMotion& motion = from.point.motion;
  const Model model = model_at(from.point.parameter);
  const auto before = half_change(model, motion, parameters.search);
  const auto after = half_change(model_at(to.point.parameter), to.point.motion, parameters.search);
  if (!before || !after) return {};
  // The motion of half the period lies between the two, because its distance from each is in
  // proportion to the change.
  const double share = before->norm() / (before->norm() + after->norm());
  Guess guess{motion.start, 0.5 * motion.period, motion.turns / 2, motion.held,
              motion.frame != 0.0};
  guess.start.q += share * (to.point.motion.start.q - motion.start.q);
  guess.start.v += share * (to.point.motion.start.v - motion.start.v);
  const PeriodicMotion half = find_periodic_motion(model, guess, parameters.search);
  if (!half.found()) return {};
  // Along the branch of half the period to the multiplier -1, by the secant method.
  const double towards = to.point.parameter - from.point.parameter;
  const BranchCorrector corrector(model_at, from.point.parameter, half, parameters);
  const auto begin = corrector.first(towards < 0.0 ? -1.0 : 1.0);
  if (!begin) return {};
  double last = 0.0, at = 0.1 * parameters.first_step;
  auto of_last = off_flip(begin->point.motion);
  for (int k = 0; of_last && k < kMostSecants; ++k) {
    const auto point = corrector.next(*begin, at);
    const auto value = point ? off_flip(point->point.motion) : std::nullopt;
    if (!value) return {};
    if (std::abs(*value) <= kOnFlip)
      return BranchPoint{PointKind::kPeriodDoubling, point->point.parameter,
                         twice(point->point.motion)};
    const double next = at - *value * (at - last) / (*value - *of_last);
    last = std::exchange(at, next);
    of_last = value;
  }
  return {};
}

}  // namespace rotorub::periodic
