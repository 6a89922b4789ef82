#include "native_model/periodic/continuation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <utility>

#include "native_model/periodic/branch_corrector.h"
#include "native_model/periodic/guesses.h"
#include "native_model/periodic/period_doubling.h"

namespace rotorub::periodic {
namespace {

constexpr int kMostRefinements = 40;
constexpr double kRefined = 1e-11;      // relative to the arclength between two points
constexpr double kZero = 1e-11;         // a test function below this counts as 0
constexpr double kGrazingWidth = 1e-6;  // relative to the arclength between two points
constexpr double kReal = 1e-9;          // relative; smaller imaginary parts count as 0

// Number of corrections by Newton's method with the derivative of a nearby point.
constexpr int kFewCorrections = 7, kManyCorrections = 12;
// The next step is longer after few corrections, and shorter after many.
constexpr double kLengthen = 1.5, kShorten = 0.6;
constexpr double kOfLastStep = 0.999;  // length of the last step / distance to the range's end
// At this share of the first step beyond a point, the events of the motion there are examined.
constexpr double kBeyond = 0.05;

// A multiplier counts as outside the unit circle only beyond 1 + kUnitCircle, because the
// multipliers of undamped motions lie on it.
constexpr double kUnitCircle = 1e-7;

using Complex = std::complex<double>;

bool is_real(const Complex& m) { return std::abs(m.imag()) <= kReal * std::abs(m); }

bool is_of(PointKind kind, const Complex& m) {
  if (kind == PointKind::kTorus) return !is_real(m);
  return is_real(m) && (m.real() < 0.0) == (kind == PointKind::kPeriodDoubling);
}

// The number of multipliers of a kind outside the unit circle.
int unstable(PointKind kind, const CorrectedPoint& at) {
  return static_cast<int>(std::ranges::count_if(at.point.motion.multipliers, [&](const Complex& m) {
    return is_of(kind, m) && std::abs(m) > 1.0 + kUnitCircle;
  }));
}

// Zero at a point of this kind: dp/ds, the product of all 1 + m for a period doubling, which needs
// no real multiplier on either side, or |m| - 1 of the multiplier next to the unit circle.
std::optional<double> test_of(PointKind kind, const CorrectedPoint& at) {
  if (kind == PointKind::kFold) return at.tangent.parameter;
  if (kind == PointKind::kPeriodDoubling) {
    Complex product = 1.0;
    for (const Complex& m : at.point.motion.multipliers) product *= (1.0 + m) / (1.0 + std::abs(m));
    return product.real();
  }
  std::optional<double> nearest;
  for (const Complex& m : at.point.motion.multipliers) {
    const double off = std::abs(m) - 1.0;
    if (is_of(kind, m) && (!nearest || std::abs(off) < std::abs(*nearest))) nearest = off;
  }
  return nearest;
}

// The point of this kind between `from` and the point at the arclength `step` from it, by the
// Illinois method.
std::optional<BranchPoint> refined(const BranchCorrector& corrector, PointKind kind,
                                   const CorrectedPoint& from, const CorrectedPoint& to,
                                   double step) {
  auto f_low = test_of(kind, from), f_high = test_of(kind, to);
  if (!f_low || !f_high || *f_low * *f_high > 0.0) return {};
  double low = 0.0, high = step, of_low = *f_low, of_high = *f_high;
  std::optional<BranchPoint> found;
  for (int i = 0; i < kMostRefinements && high - low > kRefined * step; ++i) {
    const double at = (low * of_high - high * of_low) / (of_high - of_low);
    const auto point = corrector.next(from, at);
    const auto value = point ? test_of(kind, *point) : std::nullopt;
    if (!value) return {};
    found = point->point;
    found->kind = kind;
    if (std::abs(*value) <= kZero) break;
    if (*value * of_high < 0.0) {
      low = high;
      of_low = of_high;
    } else {
      of_low *= 0.5;
    }
    high = at;
    of_high = *value;
    if (low > high) {
      std::swap(low, high);
      std::swap(of_low, of_high);
    }
  }
  return found;
}

// The last point with the events of `from`, by bisection.
std::optional<BranchPoint> grazing(const BranchCorrector& corrector, const CorrectedPoint& from,
                                   double step) {
  double low = 0.0, high = step;
  BranchPoint found = from.point;
  while (high - low > kGrazingWidth * step) {
    const double middle = 0.5 * (low + high);
    const auto point = corrector.next(from, middle);
    if (point && point->events == from.events) {
      low = middle;
      found = point->point;
    } else {
      high = middle;
    }
  }
  found.kind = PointKind::kGrazing;
  return found;
}

void add_special_points(const BranchCorrector& corrector, const CorrectedPoint& from,
                        const CorrectedPoint& to, double step, std::vector<BranchPoint>& points) {
  const auto add = [&points](const std::optional<BranchPoint>& point) {
    if (point) points.push_back(*point);
  };
  if (from.events != to.events) add(grazing(corrector, from, step));
  const bool folds = from.tangent.parameter * to.tangent.parameter < 0.0;
  if (folds) add(refined(corrector, PointKind::kFold, from, to, step));
  for (const PointKind kind :
       {PointKind::kBranching, PointKind::kPeriodDoubling, PointKind::kTorus}) {
    if (folds && kind == PointKind::kBranching) continue;
    if (unstable(kind, from) != unstable(kind, to)) add(refined(corrector, kind, from, to, step));
  }
}

// Begins the period of `now` at its best instant. False if this leads to no other point.
bool restart(const std::function<Model(double)>& model_at, const ContinuationParameters& parameters,
             std::unique_ptr<BranchCorrector>& corrector, CorrectedPoint& now) {
  const double parameter = now.point.parameter;
  const PeriodicMotion& motion = now.point.motion;
  const Model model = model_at(parameter);
  const FoundGuess begun = at_best_instant(
      model, {motion.start, motion.period, motion.turns, motion.held, motion.frame != 0.0},
      parameters.search.event);
  if (begun.status != Status::kOk) return false;
  const PeriodicMotion same = find_periodic_motion(model, begun.guess, parameters.search);
  if (!same.found()) return false;
  auto other = std::make_unique<BranchCorrector>(model_at, parameter, same, parameters);
  auto at = other->first(now.tangent.parameter);
  if (!at) return false;
  corrector = std::move(other);
  now = std::move(*at);
  return true;
}

// True if the branch ends between two points, at a period doubling of motions of half the period.
bool ends_between(const std::function<Model(double)>& model_at,
                  const ContinuationParameters& parameters, const CorrectedPoint& now,
                  const CorrectedPoint& next, Branch& branch) {
  if (!has_half_period_between(model_at, parameters, now, next)) return false;
  branch.end = kAtDoubling;
  const auto end = half_period_between(model_at, parameters, now, next);
  if (end) branch.points.push_back(*end);
  return true;
}

// The point next to the end of the parameter's range, which the next step would pass.
void add_last_point(const std::function<Model(double)>& model_at, const BranchCorrector& corrector,
                    const CorrectedPoint& now, const ContinuationParameters& parameters,
                    Branch& branch) {
  branch.end = "the parameter leaves its range";
  const double rate = parameters.scale * now.tangent.parameter;
  const double end = rate > 0.0 ? parameters.highest : parameters.lowest;
  const double step = kOfLastStep * (end - now.point.parameter) / rate;
  if (step < parameters.least_step) return;
  const auto last = corrector.next(now, step);
  if (!last || ends_between(model_at, parameters, now, *last, branch)) return;
  add_special_points(corrector, now, *last, step, branch.points);
  branch.points.push_back(last->point);
}

// Follows the branch from `now`, the last of its points.
void follow(const std::function<Model(double)>& model_at, const ContinuationParameters& parameters,
            std::unique_ptr<BranchCorrector> corrector, CorrectedPoint now, Branch& branch) {
  double step = parameters.first_step;
  bool can_restart = false;  // from another instant of the period
  while (static_cast<int>(branch.points.size()) < parameters.most_points) {
    auto next = corrector->next(now, step);
    if (!next) {
      if (step <= parameters.first_step && !corrector->stays_in_range(now, step)) {
        add_last_point(model_at, *corrector, now, parameters, branch);
        return;
      }
      step *= 0.5;
      if (step >= parameters.least_step) continue;
      if (can_restart && restart(model_at, parameters, corrector, now)) {
        can_restart = false;
        step = parameters.first_step;
        continue;
      }
      branch.end = "Newton's method does not converge beyond the last point";
      const double beyond = kBeyond * parameters.first_step;
      if (corrector->stays_in_range(now, beyond) && corrector->events_change(now, beyond)) {
        branch.end = "a contact grazes";
        if (branch.points.back().kind == PointKind::kRegular)
          branch.points.back().kind = PointKind::kGrazing;
      }
      return;
    }
    if (ends_between(model_at, parameters, now, *next, branch)) return;
    add_special_points(*corrector, now, *next, step, branch.points);
    branch.points.push_back(next->point);
    can_restart = true;
    const int corrections = next->point.motion.iterations;
    now = std::move(*next);
    if (corrections <= kFewCorrections) step = std::min(kLengthen * step, parameters.longest_step);
    if (corrections >= kManyCorrections) step *= kShorten;
  }
  branch.end = "the largest number of points is reached";
}

}  // namespace

const char* to_string(PointKind kind) {
  switch (kind) {
    case PointKind::kRegular:
      return "regular";
    case PointKind::kFold:
      return "fold";
    case PointKind::kBranching:
      return "branching";
    case PointKind::kPeriodDoubling:
      return "period doubling";
    case PointKind::kTorus:
      return "torus";
    case PointKind::kGrazing:
      return "grazing";
  }
  return "";
}

Branch continue_branch(const std::function<Model(double)>& model_at, double parameter,
                       const PeriodicMotion& start, const ContinuationParameters& parameters) {
  Branch branch;
  auto corrector = std::make_unique<BranchCorrector>(model_at, parameter, start, parameters);
  auto begin = corrector->first(parameters.direction);
  if (!begin) {
    branch.end = "the start is not a periodic motion, or has no tangent";
    return branch;
  }
  branch.points.push_back(begin->point);
  follow(model_at, parameters, std::move(corrector), std::move(*begin), branch);
  return branch;
}

Branch continue_doubled(const std::function<Model(double)>& model_at, const BranchPoint& doubling,
                        const ContinuationParameters& parameters) {
  Branch branch;
  auto begun = doubled_branch(model_at, doubling, parameters);
  if (!begun) {
    branch.end = "no motion of twice the period is found beside the period doubling";
    return branch;
  }
  branch.points = {begun->begin, begun->first.point};
  follow(model_at, parameters, std::move(begun->corrector), std::move(begun->first), branch);
  return branch;
}

}  // namespace rotorub::periodic
