#include "native_model/event/impact.h"

#include <algorithm>
#include <span>

#include "native_model/contact/impact_phase.h"
#include "native_model/system/actuation.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {

EventImpact::EventImpact(const Model& model, const EventParameters& parameters, Phase& phase,
                         Constraint& constraint, Observer& observer)
    : model_(&model),
      parameters_(&parameters),
      phase_(&phase),
      constraint_(&constraint),
      observer_(&observer) {
  const auto n = static_cast<std::size_t>(model.nq());
  for (auto* buffer : {&force_, &acceleration_, &before_, &after_}) buffer->assign(n, 0.0);
}

// (ddot, Omega_c).
Eigen::Vector3d EventImpact::contact_velocity(const Motion& motion) const {
  const Eigen::Vector2d d = rotor_point(*model_, motion.v()) - stator_point(*model_, motion.v());
  return {d.x(), d.y(), contact_spin(*model_, motion.v())};
}

// Pressed by gddot_N < 0, the flight after an impact takes 2 eps_N |gdot_N| / |gddot_N|. Where the
// impact itself lasts as long there is no flight.
bool EventImpact::impact_longer_than_flight(const Motion& motion, const ContactPoint& touch) {
  const ContactParameters& c = *model_->contact;
  const double duration = c.impact_time();
  if (duration == 0.0) return false;
  const double pressed = -phase_->contact(motion.t, motion.y.data()).b.normal;
  return -2.0 * c.restitution * touch.gap_rate < pressed * duration;
}

EventImpact::Outcome EventImpact::run(Motion& motion, const ContactPoint& touch, double end) {
  const ContactParameters& c = *model_->contact;
  Impact record;
  record.t = motion.t;
  record.gap_rate_before = touch.gap_rate;
  record.slip_before = touch.slip;
  ImpactInput in;
  in.admittance = contact_admittance(*model_, motion.t, motion.q());
  in.e_r = touch.e_r;
  in.radius = c.radius;
  in.delta = c.clearance;
  in.velocity = contact_velocity(motion);
  in.acceleration.setZero();
  const ImpactLaw law = c.law();
  if (-touch.gap_rate < parameters_->zeno_velocity_threshold ||
      impact_longer_than_flight(motion, touch)) {
    return at_once(motion, touch, {c.friction, 0.0, 0.0}, in, record);
  }
  if (c.impact_time() == 0.0) return at_once(motion, touch, law, in, record);
  return over_time(motion, touch, law, in, record, end);
}

EventImpact::Outcome EventImpact::at_once(Motion& motion, const ContactPoint& touch,
                                          const ImpactLaw& law, const ImpactInput& in,
                                          Impact& record) {
  const ImpactResult r = solve_impact(in, law);
  if (r.status != Status::kOk) return {r.status};
  constraint_->apply(motion, touch.e_r, r.normal(), r.friction());
  record.gap_rate_after = r.gap_rate;
  record.slip_after = r.slip;
  observer_->account(record, r.normal(), r.friction(), {touch.gap_rate, touch.slip},
                     {r.gap_rate, r.slip});
  observer_->record_impact(record);
  const bool stuck = r.slip == 0.0;
  if (r.gap_rate > 0.0) return {r.status, Outcome::kParts};
  if (r.gap_rate == 0.0) {
    constraint_->project(motion,
                         stuck ? Constraint::Velocity::kStuck : Constraint::Velocity::kAlong);
  }
  return {r.status, Outcome::kRests, stuck};
}

// The loads of the touch act on during the impact, the coordinates move by
// qdot_C tau_C + qdot_E tau_E, and the clock goes on.
EventImpact::Outcome EventImpact::over_time(Motion& motion, const ContactPoint& touch,
                                            const ImpactLaw& law, ImpactInput& in, Impact& record,
                                            double end) {
  const Model& m = *model_;
  const ContactParameters& c = *m.contact;
  const double t = motion.t;
  smooth_force(m, t, motion.q(), motion.v(), phase_->command(t, motion.y.data()), force_.data());
  solve_mass(m, t, motion.q(), force_.data(), acceleration_.data());
  in.acceleration = contact_acceleration(m, acceleration_.data());
  in.compression_time = c.compression_time;
  in.expansion_time = c.expansion_time;
  ImpactLaw own = law;
  own.restitution = restitution_beside_loads(law.restitution, -touch.gap_rate,
                                             pressing(touch, in.acceleration), c.compression_time,
                                             c.expansion_time);
  const ImpactResult r = solve_impact(in, own);
  if (r.status != Status::kOk) return {r.status};
  phase_of(motion, touch.e_r, c.compression_time, r.normal_compression, r.friction_compression,
           record, end);
  phase_of(motion, touch.e_r, c.expansion_time, r.normal_expansion, r.friction_expansion, record,
           end);
  const ContactPoint after = contact_point(m, motion.q(), motion.v());
  record.gap_rate_after = after.gap_rate;
  record.slip_after = after.slip;
  observer_->record_impact(record);
  if (after.gap > 0.0 || motion.t >= end) return {r.status, Outcome::kInside};
  // The straight path has left the circle: the way back to it is no work of the contact.
  const bool parts = after.gap_rate > 0.0;
  const double stored = energy(m, motion.t, motion.q(), motion.v());
  constraint_->project(motion, parts ? Constraint::Velocity::kKept : Constraint::Velocity::kAlong);
  motion.integral(kExternalWork) += energy(m, motion.t, motion.q(), motion.v()) - stored;
  return {r.status, parts ? Outcome::kParts : Outcome::kRests};
}

// One phase (contact/impact_phase.h), over tau; normal and friction force are p / tau. A run that ends
// within it takes the part until then.
void EventImpact::phase_of(Motion& motion, const Eigen::Vector2d& e_r, double tau, double normal,
                           double friction, Impact& record, double end) {
  if (motion.t >= end) return;
  const Model& m = *model_;
  const auto n = static_cast<std::size_t>(m.nq());
  const bool cut = end - motion.t < tau;
  const double dt = cut ? end - motion.t : tau, share = cut ? dt / tau : 1.0;
  double *v = motion.v(), *v0 = before_.data(), *v1 = after_.data();
  const auto rates = [&] { return rates_along(e_r, m.contact->radius, contact_velocity(motion)); };

  // v_1 of the whole phase, and what is seen on the way.
  std::copy_n(v, n, v0);
  const double rate_before = rates().x();
  load_phase(tau, acceleration_, before_, {v, n});
  constraint_->apply(motion, e_r, normal, friction);
  std::copy_n(v, n, v1);
  const double until = cut ? end : motion.t + dt;
  std::copy_n(v0, n, v);
  if (tau > 0.0) {
    observer_->watch(motion, {tau, until, v0, v1, normal / tau, friction / tau});
  }

  // The part that there is of it.
  load_phase(dt, acceleration_, before_, {v, n});
  double& work = motion.integral(kExternalWork);
  add_load_work(dt, std::span(force_).first(static_cast<std::size_t>(m.layout.mechanical())), v0, v, work);
  const Eigen::Vector2d loaded = rates();
  constraint_->apply(motion, e_r, share * normal, share * friction);
  const double rate_after = rates().x();
  observer_->account(record, share * normal, share * friction, loaded, rates());
  motion.integral(kGapRateSquare) +=
      dt / 3.0 * (rate_before * (rate_before + rate_after) + rate_after * rate_after);
  work -= energy(m, motion.t, motion.q(), v);
  for (std::size_t i = 0; i < n; ++i) motion.q()[i] += dt * v1[i];
  motion.t = until;
  work += energy(m, motion.t, motion.q(), v);
}

}  // namespace rotorub
