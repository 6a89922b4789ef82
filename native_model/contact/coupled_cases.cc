#include "native_model/contact/coupled_cases.h"

#include <algorithm>
#include <cmath>

namespace rotorub::coupled_cases {
namespace {

constexpr double kCaseRoundOff = 1e-11;  // relative to the rates and impulses of the problem

}  // namespace

bool distinct(const Case& c, const ContactSet& set) {
  if (set.normal_known && !c.at_bound) return false;
  if (c.friction == Bound::kLow) return true;
  const bool one_bound = set.slides != 0.0 || (set.friction == 0.0 && set.floor == 0.0);
  return !one_bound && !(c.at_bound && set.least_normal == 0.0);
}

CoupledProblem::CoupledProblem(const ContactMatrix& a, const ContactVector& b,
                               std::span<const ContactSet> sets)
    : a_(a), b_(b), sets_(sets), n_(static_cast<int>(sets.size())) {
  rate_ = b.cwiseAbs().maxCoeff();
  for (int i = 0; i < n_; ++i) impulse_ = std::max(impulse_, set(i).least_normal);
  rate_ = std::max(rate_, impulse_ * a.cwiseAbs().maxCoeff());
}

Cases CoupledProblem::all_closed(const Cases& cases, const CoupledSolution& s) const {
  const double rates =
      kCaseRoundOff * (rate_ + s.p.cwiseAbs().maxCoeff() * a_.cwiseAbs().maxCoeff());
  Cases closed = cases;
  for (int i = 0; i < n_; ++i) {
    Case& c = closed[static_cast<std::size_t>(i)];
    if (set(i).normal_known || !c.at_bound || s.y[2 * i] > rates) continue;
    const double slip = s.y[2 * i + 1];
    c = {false, slip > rates ? Bound::kLow : slip < -rates ? Bound::kHigh : Bound::kStick};
    if (!distinct(c, set(i))) c.friction = Bound::kLow;
  }
  return closed;
}

Cases CoupledProblem::cases_of(const ContactVector& p) const {
  const ContactVector y = a_ * p + b_;
  const auto next = [&](Eigen::Index row) {
    return a_(row, row) > 0.0 ? p[row] - y[row] / a_(row, row) : p[row];
  };
  Cases cases{};
  for (int i = 0; i < n_; ++i) {
    const double friction = next(2 * i + 1);
    Case& c = cases[static_cast<std::size_t>(i)];
    c.at_bound = set(i).normal_known || next(2 * i) <= set(i).least_normal;
    c.friction = friction < set(i).low(p[2 * i])    ? Bound::kLow
                 : friction > set(i).high(p[2 * i]) ? Bound::kHigh
                                                    : Bound::kStick;
    if (!distinct(c, set(i))) c.friction = Bound::kLow;
  }
  return cases;
}

std::optional<CoupledSolution> CoupledProblem::solution_of(const Cases& cases) const {
  CoupledSolution out;
  out.solutions = 1;
  out.p = impulses(cases);
  if (!out.p.allFinite()) return {};
  out.y = a_ * out.p + b_;
  const double largest = std::max(out.p.cwiseAbs().maxCoeff(), impulse_);
  const double rates = kCaseRoundOff * (rate_ + largest * a_.cwiseAbs().maxCoeff());
  const double impulses = kCaseRoundOff * largest;
  for (int i = 0; i < n_; ++i) {
    if (!in_set(cases[static_cast<std::size_t>(i)], set(i), i, out, rates, impulses)) return {};
  }
  return out;
}

ContactVector CoupledProblem::impulses(const Cases& cases) const {
  CaseSystem s(2 * n_);
  for (int i = 0; i < n_; ++i) {
    const Case& c = cases[static_cast<std::size_t>(i)];
    const int normal = 2 * i, friction = normal + 1;
    if (c.at_bound) {
      s.given[normal] = set(i).least_normal;
    } else {
      s.set_unknown(normal);
    }
    if (c.friction == Bound::kStick) {
      s.set_unknown(friction);
      continue;
    }
    const auto bound = [&](double l) {
      return c.friction == Bound::kLow ? set(i).low(l) : set(i).high(l);
    };
    s.given[friction] = bound(s.given[normal]);
    if (!c.at_bound) s.tie(friction, bound(1.0) - bound(0.0));
  }
  return s.solve(a_, b_);
}

bool CoupledProblem::in_set(const Case& c, const ContactSet& set, int i, CoupledSolution& s,
                            double rates, double impulses) {
  double &normal = s.p[2 * i], &friction = s.p[2 * i + 1];
  double &gap_rate = s.y[2 * i], &slip = s.y[2 * i + 1];
  if (!set.normal_known) {
    if (c.at_bound ? gap_rate < -rates : std::abs(gap_rate) > rates) return false;
    if (normal < set.least_normal - impulses) return false;
    normal = std::max(normal, set.least_normal);
    gap_rate = c.at_bound ? std::max(gap_rate, 0.0) : 0.0;  // removes round-off
  }
  const double low = set.low(normal), high = set.high(normal);
  const bool one_bound = high - low <= impulses;
  s.sticks[static_cast<std::size_t>(i)] = c.friction == Bound::kStick;
  switch (c.friction) {
    case Bound::kLow:
      return one_bound || slip >= -rates;
    case Bound::kHigh:
      return slip <= rates;
    case Bound::kStick:
      if (std::abs(slip) > rates || friction < low - impulses || friction > high + impulses) {
        return false;
      }
      friction = std::clamp(friction, low, std::max(low, high));
      slip = 0.0;
  }
  return true;
}

}  // namespace rotorub::coupled_cases
