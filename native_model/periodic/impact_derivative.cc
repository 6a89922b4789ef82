#include "native_model/periodic/impact_derivative.h"

#include <algorithm>
#include <cmath>

#include "native_model/event/smooth_system.h"
#include "native_model/model/dynamics.h"
#include "native_model/periodic/contact_gradients.h"

namespace rotorub::periodic {
namespace {

constexpr double kOnTheCircle = 1e-10;  // of the clearance; smaller gaps are closed
constexpr double kOfState = 1e-3;       // of the sizes of the state
constexpr double kOfRates = 1e-2;       // of the approach and of the slip, which keep their signs

}  // namespace

ImpactDerivative::ImpactDerivative(const Model& model, double t, const Jump& jump,
                                   const ContactStates& before, const Eigen::VectorXd& sizes,
                                   bool no_rebound)
    : model_(&model), t_(t), jump_(&jump), sizes_(&sizes), constraint_(model) {
  const double* y = jump.before.data();
  for (std::size_t k = 0; k < before.size(); ++k) {
    const auto& contact = model.auxiliary[k].contact;
    if (!contact || contact->is_compliant()) continue;
    const bool lasts = before[k].mode != ContactMode::kFree;
    const double gap = contact_point(model, y, y + model.nq(), k).gap;
    if (lasts) lasting_.push_back({k, velocity_of(before[k].mode)});
    if (!lasts && !before[k].redundant && k != jump.contact &&
        gap > kOnTheCircle * contact->clearance) {
      continue;
    }
    closed_.push_back({k, Constraint::Velocity::kAny});
    ImpactLaw law = contact->impact_law();
    if (no_rebound) law = {law.friction, 0.0, 0.0};
    laws_.push_back(law);
  }
}

Eigen::VectorXd ImpactDerivative::after(const Eigen::VectorXd& y) {
  Eigen::VectorXd to = y;
  double *q = to.data(), *v = q + model_->nq();
  if (!lasting_.empty()) constraint_.project(t_, q, v, lasting_);
  const auto points = closed_points(*model_, q, v, closed_);
  ContactVector rates(static_cast<Eigen::Index>(2 * points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& p = points[i].point;
    rates.segment<2>(static_cast<Eigen::Index>(2 * i)) << p.gap_rate, p.slip;
  }
  const CoupledSolution solved =
      solve_coupled_impact(delassus(*model_, t_, q, points), rates, laws_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    if (!(solved.p[at] > 0.0)) continue;
    constraint_.apply(t_, q, v, points[i].point.e_r, solved.p[at], solved.p[at + 1],
                      points[i].index);
  }
  return to;
}

double ImpactDerivative::share_of(const Eigen::VectorXd& u) const {
  const double size = u.cwiseQuotient(*sizes_).cwiseAbs().maxCoeff();
  if (!(size > 0.0) || !std::isfinite(size)) return 0.0;
  const ContactGradients at(*model_, jump_->before, jump_->contact);
  double eps = kOfState / size;
  const auto keep = [&eps](double rate, double change) {
    if (rate != 0.0 && change != 0.0) eps = std::min(eps, kOfRates * std::abs(rate / change));
  };
  keep(at.point().gap_rate, at.gap_rate().dot(u));
  keep(at.point().slip, at.slip().dot(u));
  return eps;
}

Eigen::VectorXd ImpactDerivative::along(const Eigen::VectorXd& u) {
  const double eps = share_of(u);
  if (eps == 0.0) return u;
  const Eigen::Map<const Eigen::VectorXd> y(jump_->before.data(), u.size());
  const auto at = [&](double share) { return after(y + share * eps * u); };
  return (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * eps);
}

}  // namespace rotorub::periodic
