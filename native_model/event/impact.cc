#include "native_model/event/impact.h"

#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

// Relative to the approach; smaller gap rates are round-off. A resting contact then stays exactly
// at rest when the others rebound.
constexpr double kNoRate = 1e-12;

}  // namespace

EventImpact::EventImpact(const Model& model, const EventParameters& parameters,
                         SmoothSystem& system, Constraint& constraint, Observer& observer)
    : model_(&model),
      parameters_(&parameters),
      system_(&system),
      constraint_(&constraint),
      observer_(&observer),
      finite_(model) {}

EventImpact::Outcome EventImpact::run(Motion& motion, std::span<const ClosedContact> closed,
                                      double end) {
  if (takes_time(motion, closed.front())) return over_time(motion, closed.front().point, end);
  return at_once(motion, closed);
}

// An impact takes no time where an accumulation ends, or if the flight after it would be shorter
// than the impact. It then has no rebound.
bool EventImpact::takes_time(const Motion& motion, const ClosedContact& touch) const {
  const ContactParameters& c = *model_->auxiliary[touch.index].contact;
  const double approach = -touch.point.gap_rate;
  if (c.impact_time() == 0.0 || approach < parameters_->zeno_velocity_threshold) return false;
  ClosedContact only = touch;
  const double a = -system_->accelerations(motion.t, motion.y.data(), std::span(&only, 1)).b[0];
  return !(a > 0.0) || flight_outlives(c.impact_time(), c.restitution * approach, a);
}

EventImpact::Outcome EventImpact::at_once(Motion& motion, std::span<const ClosedContact> closed) {
  ContactList<ImpactLaw> laws;
  ContactVector before(static_cast<Eigen::Index>(2 * closed.size()));
  double approach = 0.0;
  // An impact that takes time comes here only if it does not rebound (takes_time()).
  bool without_rebound = false;
  for (const ClosedContact& c : closed) {
    const ContactParameters& contact = *model_->auxiliary[c.index].contact;
    before.segment<2>(static_cast<Eigen::Index>(2 * laws.size())) << c.point.gap_rate, c.point.slip;
    laws.push_back(contact.impact_law());
    without_rebound = without_rebound || contact.impact_time() > 0.0;
    approach = std::max(approach, -c.point.gap_rate);
  }
  // At the end of an accumulation no contact rebounds: neither the contact that closes nor any
  // contact that it would open.
  const bool is_last = approach < parameters_->zeno_velocity_threshold;
  if (without_rebound || is_last) {
    for (ImpactLaw& law : laws) law = {law.friction, 0.0, 0.0};
  }
  const CoupledSolution solved =
      solve_coupled_impact(delassus(*model_, motion.t, motion.q(), closed), before, laws);
  Outcome out{status_of(solved.solutions), {}, is_last};
  if (out.status != Status::kOk) return out;
  ContactList<Constraint::Closed> resting;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    const std::size_t contact = closed[i].index;
    const double normal = solved.p[at], friction = solved.p[at + 1];
    const bool rests = solved.y[at] <= kNoRate * approach;
    const bool stuck = solved.sticks[i] && solved.y[at + 1] == 0.0;
    out.contacts.push_back({contact, normal > 0.0, rests, stuck, Departure::kRebound});
    if (rests) {
      resting.push_back(
          {contact, stuck ? Constraint::Velocity::kZero : Constraint::Velocity::kTangential});
    }
    if (!(normal > 0.0)) continue;
    constraint_->apply(motion.t, motion.q(), motion.v(), closed[i].point.e_r, normal, friction,
                       contact);
    Impact record;
    record.t = motion.t;
    record.contact = static_cast<int>(contact);
    record.gap_rate_before = before[at];
    record.slip_before = before[at + 1];
    record.gap_rate_after = solved.y[at];
    record.slip_after = solved.y[at + 1];
    observer_->account(record, normal, friction, {before[at], before[at + 1]},
                       {solved.y[at], solved.y[at + 1]});
    observer_->record_impact(record);
  }
  if (!resting.empty()) constraint_->project(motion.t, motion.q(), motion.v(), resting);
  return out;
}

// Advances the time (model/finite_impact.h). If the run ends within the impact, only the part until
// then counts.
EventImpact::Outcome EventImpact::over_time(Motion& motion, const ContactPoint& touch, double end) {
  const Status status = finite_.begin(motion.t, motion.q(), motion.v(),
                                      system_->command(0, motion.t, motion.y.data()), false);
  if (status != Status::kOk) return {status};
  Impact record;
  record.t = motion.t;
  record.gap_rate_before = touch.gap_rate;
  record.slip_before = touch.slip;
  for (std::size_t k = 0; k < FiniteImpact::kPhases && motion.t < end; ++k) {
    const double tau = finite_.duration(k);
    const bool cut = end - motion.t < tau;
    const double dt = cut ? end - motion.t : tau, until = cut ? end : motion.t + tau;
    const double *from = finite_.from(k), *to = finite_.to(k);
    if (tau > 0.0) observer_->watch(motion, finite_, k, until);
    const FiniteImpact::Part part = finite_.part(k, dt);
    observer_->account(record, part.normal, part.friction, part.before, part.after);
    motion.integral(kExternalWork) += part.external_work;
    const double first = finite_.rates(from).x(), last = part.after.x();
    motion.integral(kGapRateSquare) += dt / 3.0 * (first * (first + last) + last * last);
    const double share = cut ? dt / tau : 1.0;
    for (int i = 0; i < motion.nq; ++i) {
      motion.q()[i] += dt * to[i];
      motion.v()[i] = cut ? from[i] + share * (to[i] - from[i]) : to[i];
    }
    motion.t = until;
  }
  const ContactPoint after = contact_point(*model_, motion.q(), motion.v());
  record.gap_rate_after = after.gap_rate;
  record.slip_after = after.slip;
  observer_->record_impact(record);
  Outcome out;
  if (finite_.is_inside() || motion.t >= end) {
    out.contacts.push_back({0, true, false, false, Departure::kInside});
    return out;
  }
  const FiniteImpact::End finish = finite_.finish();
  std::copy_n(finish.q, motion.nq, motion.q());
  std::copy_n(finish.v, motion.nq, motion.v());
  motion.integral(kExternalWork) += finite_.landing_work();
  out.contacts.push_back({0, true, finish.lasts, false, Departure::kRebound});
  return out;
}

}  // namespace rotorub
