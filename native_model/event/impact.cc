#include "native_model/event/impact.h"

#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {

EventImpact::EventImpact(const Model& model, const EventParameters& parameters, Phase& phase,
                         Observer& observer)
    : model_(&model),
      parameters_(&parameters),
      phase_(&phase),
      observer_(&observer),
      finite_(model) {}

bool EventImpact::rebounds(const Motion& motion, const ContactPoint& touch) const {
  const ContactParameters& c = *model_->first().contact;
  if (c.impact_time() == 0.0 || -touch.gap_rate < parameters_->zeno_velocity_threshold)
    return false;
  const double pressed = -phase_->contact(0, motion.t, motion.y.data()).b.normal;
  if (!(pressed > 0.0)) return true;
  return flight_outlives(c.impact_time(), -c.restitution * touch.gap_rate, pressed);
}

// The clock goes on (system/finite_impact.h). A run that ends within the impact takes the part
// until then.
EventImpact::Outcome EventImpact::run(Motion& motion, const ContactPoint& touch, double end) {
  const Status status = finite_.begin(motion.t, motion.q(), motion.v(),
                                      phase_->command(0, motion.t, motion.y.data()), false);
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
