#include "native_model/event/impact.h"

#include <algorithm>

#include "native_model/contact/rebound.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {

EventImpact::EventImpact(const Model& model, const EventParameters& parameters, Phase& phase,
                         Constraint& constraint, Observer& observer)
    : model_(&model),
      parameters_(&parameters),
      phase_(&phase),
      constraint_(&constraint),
      observer_(&observer),
      finite_(model) {}

bool EventImpact::rebound_lasts(const Motion& motion, const ContactPoint& touch) const {
  if (-touch.gap_rate < parameters_->zeno_velocity_threshold) return false;
  const ContactParameters& c = parameters_of_contact();
  if (c.impact_time() == 0.0) return true;
  const double pressed = -phase_->contact(contact_, motion.t, motion.y.data()).b.normal;
  if (!(pressed > 0.0)) return true;
  return flight_outlives(c.impact_time(), -c.restitution * touch.gap_rate, pressed);
}

EventImpact::Outcome EventImpact::run(std::size_t contact, Motion& motion, const ContactPoint& touch,
                                      double end) {
  contact_ = contact;
  const ContactParameters& c = parameters_of_contact();
  if (!rebound_lasts(motion, touch)) return at_once(motion, touch, {c.friction, 0.0, 0.0});
  return c.impact_time() == 0.0 ? at_once(motion, touch, c.law()) : over_time(motion, touch, end);
}

EventImpact::Outcome EventImpact::at_once(Motion& motion, const ContactPoint& touch,
                                          const ImpactLaw& law) {
  const Eigen::Matrix3d admittance = contact_admittance(*model_, motion.t, motion.q(), contact_);
  const ImpactResult r = solve_impact(delassus(admittance, touch.e_r, parameters_of_contact().radius),
                                      touch.gap_rate, touch.slip, law);
  if (r.status != Status::kOk) return {r.status};
  constraint_->apply(motion, touch.e_r, r.normal(), r.friction(), contact_);
  Impact record;
  record.t = motion.t;
  record.contact = static_cast<int>(contact_);
  record.gap_rate_before = touch.gap_rate;
  record.slip_before = touch.slip;
  record.gap_rate_after = r.gap_rate;
  record.slip_after = r.slip;
  observer_->account(record, r.normal(), r.friction(), {touch.gap_rate, touch.slip},
                     {r.gap_rate, r.slip});
  observer_->record_impact(record);
  const bool stuck = r.slip == 0.0;
  if (r.gap_rate > 0.0) return {r.status, Outcome::kParts};
  if (r.gap_rate == 0.0) {
    const Constraint::Closed closed{contact_, stuck ? Constraint::Velocity::kStuck : Constraint::Velocity::kAlong};
    constraint_->project(motion, std::span(&closed, 1));
  }
  return {r.status, Outcome::kRests, stuck};
}

// The clock goes on (system/finite_impact.h). A run that ends within the impact takes the part
// until then.
EventImpact::Outcome EventImpact::over_time(Motion& motion, const ContactPoint& touch, double end) {
  const Status status = finite_.begin(motion.t, motion.q(), motion.v(),
                                      phase_->command(contact_, motion.t, motion.y.data()), false);
  if (status != Status::kOk) return {status};
  Impact record;
  record.t = motion.t;
  record.contact = static_cast<int>(contact_);
  record.gap_rate_before = touch.gap_rate;
  record.slip_before = touch.slip;
  for (std::size_t k = 0; k < FiniteImpact::kPhases && motion.t < end; ++k) {
    const double tau = finite_.duration(k);
    const bool cut = end - motion.t < tau;
    const double dt = cut ? end - motion.t : tau, until = cut ? end : motion.t + tau;
    const double *from = finite_.from(k), *to = finite_.to(k);
    if (tau > 0.0) {
      const Eigen::Vector2d force = finite_.phase_force(k);
      observer_->watch(motion, {tau, until, from, to, force.x(), force.y()});
    }
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
  if (finite_.is_inside() || motion.t >= end) return {status, Outcome::kInside};
  const double *q, *v, *a;
  const bool rests = finite_.finish(q, v, a);
  std::copy_n(q, motion.nq, motion.q());
  std::copy_n(v, motion.nq, motion.v());
  motion.integral(kExternalWork) += finite_.landing_work();
  return {status, rests ? Outcome::kRests : Outcome::kParts};
}

}  // namespace rotorub
