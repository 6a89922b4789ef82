#include "native_model/model/finite_impact.h"

#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

// to = from + tau a
void load_phase(double tau, const std::vector<double>& acceleration, const double* from,
                std::vector<double>& to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + tau * acceleration[i];
}

}  // namespace

FiniteImpact::FiniteImpact(const Model& model) : model_(&model), constraint_(model) {
  const auto n = static_cast<std::size_t>(model.nq());
  for (auto* x : {&q_, &v_, &after_compression_, &after_, &end_q_, &end_v_, &end_a_, &force_,
                  &acceleration_, &scratch_q_, &scratch_v_}) {
    x->assign(n, 0.0);
  }
}

double FiniteImpact::power(double t, const double* q, const double* v,
                           const Eigen::Vector2d& command) const {
  return external_power(*model_, t, q, v, actuator_state(*model_, q, v, command).force);
}

Eigen::Vector2d FiniteImpact::rates(const double* v) const {
  return rates_along(e_r_, contact().radius, contact_rates(*model_, v));
}

double FiniteImpact::duration(std::size_t phase) const {
  return phase == 0 ? contact().compression_time : contact().expansion_time;
}

Eigen::Vector2d FiniteImpact::phase_force(std::size_t phase) const {
  if (duration(phase) == 0.0) return {0.0, 0.0};
  return Eigen::Vector2d(impulse_[2 * phase], impulse_[2 * phase + 1]) / duration(phase);
}

Status FiniteImpact::begin(double t, const double* q, const double* v,
                           const Eigen::Vector2d& command, bool follows) {
  const Model& m = *model_;
  const ContactParameters& c = contact();
  std::copy_n(q, q_.size(), q_.begin());
  std::copy_n(v, v_.size(), v_.begin());
  const ContactPoint touch = contact_point(m, q, v);
  smooth_force(m, t, q, v, command, force_.data());
  solve_mass(m, t, q, force_.data(), acceleration_.data());

  ImpactInput in;
  in.admittance = contact_admittance(m, t, q);
  in.e_r = e_r_ = touch.e_r;
  in.radius = c.radius;
  in.delta = c.clearance;
  in.velocity = {touch.dv.x(), touch.dv.y(), touch.spin};
  in.acceleration = contact_acceleration(m, acceleration_.data());
  in.compression_time = c.compression_time;
  in.expansion_time = c.expansion_time;
  ImpactLaw law = c.impact_law();
  law.restitution = restitution_under_loads(
      c.restitution, -touch.gap_rate,
      closing_acceleration(touch.e_r, in.velocity, in.acceleration, touch.delta),
      c.compression_time, c.expansion_time);
  const ImpactResult r = solve_impact(in, law);
  if (r.status != Status::kOk) return r.status;
  impulse_ = {r.normal_compression, r.friction_compression, r.normal_expansion,
              r.friction_expansion};
  touch_ = t;
  middle_ = t + c.compression_time;
  end_ = middle_ + c.expansion_time;

  load_phase(c.compression_time, acceleration_, v_.data(), after_compression_);
  constraint_.apply(t, q_.data(), after_compression_.data(), e_r_, impulse_[0], impulse_[1]);
  coordinates(middle_, scratch_q_.data());
  load_phase(c.expansion_time, acceleration_, after_compression_.data(), after_);
  constraint_.apply(middle_, scratch_q_.data(), after_.data(), e_r_, impulse_[2], impulse_[3]);

  record_ = {};
  record_.t = t;
  record_.gap_rate_before = touch.gap_rate;
  record_.slip_before = touch.slip;
  power_at_touch_ = power(t, q, v, command);
  external_work_ = 0.0;
  for (std::size_t k = 0; k < kPhases; ++k) {
    const Part all = part(k, duration(k));
    record_.normal_impulse += all.normal;
    record_.friction_impulse += all.friction;
    record_.energy_change += impulse_work(all.normal, all.friction, all.before, all.after).total();
    external_work_ += all.external_work;
  }
  land();
  external_work_ += landing_work_;
  const Eigen::Vector2d last =
      follows ? control_command(m, end_, end_q_.data(), end_v_.data()) : command;
  smooth_force(m, end_, end_q_.data(), end_v_.data(), last, end_a_.data());
  solve_mass(m, end_, end_q_.data(), end_a_.data(), end_a_.data());
  power_at_end_ = power(end_, end_q_.data(), end_v_.data(), last);
  active_ = 1.0;
  return r.status;
}

// Computes the state at the end and projects it onto the circle if the straight path has left it.
void FiniteImpact::land() {
  const Model& m = *model_;
  coordinates(end_, end_q_.data());
  end_v_ = after_;
  const ContactPoint left = contact_point(m, end_q_.data(), end_v_.data());
  record_.gap_rate_after = left.gap_rate;
  record_.slip_after = left.slip;
  inside_ = left.gap > 0.0;
  closes_ = landing_work_ = 0.0;
  if (inside_) return;
  const bool parts = left.gap_rate > 0.0;
  const double stored = energy(m, end_, end_q_.data(), end_v_.data());
  const Constraint::Closed closed{
      0, parts ? Constraint::Velocity::kAny : Constraint::Velocity::kTangential};
  constraint_.project(end_, end_q_.data(), end_v_.data(), {&closed, 1});
  landing_work_ = energy(m, end_, end_q_.data(), end_v_.data()) - stored;
  closes_ = parts ? 0.0 : 1.0;
}

FiniteImpact::Part FiniteImpact::part(std::size_t phase, double dt) const {
  const Model& m = *model_;
  const double t = begin_of(phase), share = dt < duration(phase) ? dt / duration(phase) : 1.0;
  Part p{share * impulse_[2 * phase], share * impulse_[2 * phase + 1], {}, {}, 0.0};
  double *q = scratch_q_.data(), *v = scratch_v_.data();
  coordinates(t, q);
  load_phase(dt, acceleration_, from(phase), scratch_v_);
  for (int i = 0; i < m.layout.mechanical(); ++i) {
    p.external_work += 0.5 * dt * force_[static_cast<std::size_t>(i)] * (from(phase)[i] + v[i]);
  }
  p.before = rates(v);
  constraint_.apply(t, q, v, e_r_, p.normal, p.friction);
  p.after = rates(v);
  // Growth of the stored energy along the path.
  p.external_work -= energy(m, t, q, v);
  for (std::size_t i = 0; i < scratch_q_.size(); ++i) q[i] += dt * to(phase)[i];
  p.external_work += energy(m, t + dt, q, v);
  return p;
}

void FiniteImpact::coordinates(double t, double* q) const {
  const double first = std::min(t, middle_) - touch_, second = std::max(0.0, t - middle_);
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q[i] = q_[i] + first * after_compression_[i] + second * after_[i];
  }
}

void FiniteImpact::velocities(double t, double* v) const {
  const std::size_t phase = t < middle_ ? 0 : 1;
  const double tau = phase == 0 ? middle_ - touch_ : end_ - middle_;
  const double share = tau > 0.0 ? std::min(1.0, (t - begin_of(phase)) / tau) : 1.0;
  const double *before = from(phase), *after = to(phase);
  for (std::size_t i = 0; i < v_.size(); ++i) v[i] = before[i] + share * (after[i] - before[i]);
}

Eigen::Vector2d FiniteImpact::force(double t) const {
  if (t <= touch_ || t >= end_) return {0.0, 0.0};
  return phase_force(t < middle_ ? 0 : 1);
}

FiniteImpact::End FiniteImpact::finish() {
  active_ = 0.0;
  return {end_q_.data(), end_v_.data(), end_a_.data(), closes_ > 0.0};
}

}  // namespace rotorub
